/* SPDX-License-Identifier: Apache-2.0 */
/* The mode machine beside its executable specification (specs/model): phrases of flights with
 * faults in between, and all of the machine must be the same after each step. */
#include "any.h"
#include "keel/flight/mode.h"
#include "unity.h"

#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/mode.c"

#define STEPS 1000000u

static keel_mode_t machine;
static keel_mode_input_t in;

void setUp(void)
{
    any_from(20261123u);
}

void tearDown(void)
{
}

/* Phrases of a flight that last long enough for facts to settle, with faults in between. */
static void change(void)
{
    const uint32_t estimates = any() & (KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID);
    const uint32_t ground = KEEL_MODE_RC_LINKED | KEEL_MODE_THROTTLE_LOW | KEEL_MODE_LANDED |
                            KEEL_MODE_ATTITUDE_VALID | KEEL_MODE_ALTITUDE_VALID |
                            KEEL_MODE_POSITION_VALID;

    switch (any() % 256u) {
    case 0u:
    case 1u:
        in.facts = ground | KEEL_MODE_ARM_SWITCH_OFF;
        in.asked = (uint8_t)(any() % 5u);
        break;
    case 2u:
    case 3u:
        in.facts = ground | KEEL_MODE_ARM_SWITCH_ON;
        break;
    case 4u:
    case 5u:
        in.facts = KEEL_MODE_RC_LINKED | KEEL_MODE_ARM_SWITCH_ON | KEEL_MODE_POSITION_VALID |
                   estimates;
        break;
    case 6u:
        in.facts &= ~KEEL_MODE_RC_LINKED;
        break;
    case 7u:
        in.facts |= KEEL_MODE_RC_LINKED;
        break;
    case 8u:
    case 9u:
        in.asked = (uint8_t)(any() % 7u);
        break;
    case 10u:
    case 11u:
        in.facts ^= (uint32_t)1u << (any() % 16u);
        break;
    default:
        break;
    }
    in.checks = ((any() % 16u) == 0u) ? any() : UINT32_MAX;
    in.elapsed_us = ((any() % 4096u) == 0u) ? any() : (any() % 4000u);
}

static keel_mode_config_t short_times(void)
{
    return (keel_mode_config_t){.loss_us = 10000u,
                                .regain_us = 10000u + (any() % 5000u),
                                .request_us = 10000u + (any() % 5000u),
                                .kill_us = 40000u,
                                .landed_us = 10000u + (any() % 9000u),
                                .estimate_us = 12000u,
                                .alarm_us = 30000u,
                                .idle_us = 50000u,
                                .hold_us = any() % 50000u,
                                .return_us = any() % 50000u,
                                .required = any(),
                                .returns = (any() % 2u) == 0u};
}

static void MOD_003_a_million_steps_beside_the_specification(void)
{
    uint32_t visits[KEEL_MODE_STATES] = {0u};
    keel_mode_t model;

    memset(&machine, 0, sizeof machine);
    memset(&model, 0, sizeof model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        if ((i % 4096u) == 0u) {
            const keel_mode_config_t config = short_times();

            TEST_ASSERT_EQUAL(model_mode_init(&model, &config), keel_mode_init(&machine, &config));
        }
        change();
        model_mode_step(&model, &in);
        keel_mode_step(&machine, &in);
        TEST_ASSERT_EQUAL_MEMORY(&model, &machine, sizeof model);
        visits[machine.state]++;
    }
    for (uint32_t i = 0u; i < KEEL_MODE_STATES; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(100u, visits[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MOD_003_a_million_steps_beside_the_specification);
    return UNITY_END();
}
