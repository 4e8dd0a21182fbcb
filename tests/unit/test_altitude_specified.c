/* SPDX-License-Identifier: Apache-2.0 */
/* The altitude estimator beside its executable specification (specs/model): random and adversarial
 * samples to both, after each of which every bit of the estimator must be the same. */
#include "any.h"
#include "keel/flight/altitude.h"
#include "unity.h"

#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/altitude.c"
#include "../../specs/model/axis.c"

#define STEPS 500000u

static keel_altitude_t altitude;

void setUp(void)
{
    any_from(7u);
    memset(&altitude, 0, sizeof altitude);
}

void tearDown(void)
{
}

/* Anything now and then, at a pressure that wanders. */
static keel_altitude_sample_t any_sample(void)
{
    static float pressure = 100000.0f;
    const float odd[] = {NAN,       INFINITY, -1.0f,     29999.0f,
                         120001.0f, 30000.0f, 120000.0f, any_bits()};

    pressure += between(-20.0f, 20.0f);
    pressure = ((pressure > 119000.0f) || (pressure < 31000.0f)) ? 100000.0f : pressure;
    const keel_altitude_sample_t measured = {.pressure = one_in(64u) ? odd[any() % 8u] : pressure,
                                             .acceleration = one_in(64u) ? any_bits()
                                                                         : between(-5.0f, 5.0f),
                                             .has_pressure = one_in(3u),
                                             .has_acceleration = !one_in(32u)};

    return measured;
}

static void ALT_007_every_step_is_the_specified_one(void)
{
    const keel_axis_config_t config = {.rate_hz = 50.0f,
                                       .position_gain = 0.25f,
                                       .velocity_gain = 0.5f,
                                       .bias_gain = 0.125f,
                                       .bias_limit = 1.0f,
                                       .position_gate = 20.0f,
                                       .late_steps = 10u,
                                       .lost_steps = 100u,
                                       .settle_fixes = 1u,
                                       .jump_fixes = 3u};
    keel_altitude_t model;

    memset(&model, 0, sizeof model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        const keel_altitude_sample_t measured = any_sample();

        if ((i % 2048u) == 0u) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_altitude_init(&altitude, &config));
            TEST_ASSERT_EQUAL(KEEL_OK, model_altitude_init(&model, &config));
        }
        if (one_in(512u)) {
            keel_altitude_zero(&altitude);
            model_altitude_zero(&model);
        }
        keel_altitude_step(&altitude, &measured);
        model_altitude_step(&model, &measured);
        TEST_ASSERT_EQUAL_MEMORY(&model, &altitude, sizeof altitude);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ALT_007_every_step_is_the_specified_one);
    return UNITY_END();
}
