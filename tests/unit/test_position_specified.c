/* SPDX-License-Identifier: Apache-2.0 */
/* The position estimator beside its executable specification (specs/model): random and adversarial
 * samples to both, after each of which every bit of the estimator must be the same. */
#include "any.h"
#include "keel/flight/position.h"
#include "unity.h"

#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/axis.c"
#include "../../specs/model/position.c"

#define STEPS 500000u

static keel_position_t position;

void setUp(void)
{
    any_from(11u);
    memset(&position, 0, sizeof position);
}

void tearDown(void)
{
}

static keel_position_sample_t any_sample(void)
{
    const float odd[] = {NAN, INFINITY, -1.0f, any_bits()};
    const keel_position_sample_t measured = {
        .fix = {.latitude = one_in(64u) ? (int32_t)any() : (481000000 + (int32_t)(any() % 2000u)),
                .longitude = one_in(64u) ? (int32_t)any()
                                         : (int32_t)(1799999000 + (int32_t)(any() % 2000u)),
                .north = one_in(64u) ? odd[any() % 4u] : between(-3.0f, 3.0f),
                .east = one_in(64u) ? odd[any() % 4u] : between(-3.0f, 3.0f),
                .accuracy = one_in(64u) ? odd[any() % 4u] : between(0.0f, 5.2f),
                .speed_accuracy = between(0.0f, 1.1f),
                .is_valid = !one_in(64u)},
        .north = one_in(64u) ? odd[any() % 4u] : between(-5.0f, 5.0f),
        .east = one_in(64u) ? odd[any() % 4u] : between(-5.0f, 5.0f),
        .has_fix = one_in(3u),
        .has_acceleration = !one_in(32u)};

    return measured;
}

static void POS_007_every_step_is_the_specified_one(void)
{
    const keel_position_config_t config = {.axis = {.rate_hz = 50.0f,
                                                    .position_gain = 0.25f,
                                                    .velocity_gain = 0.5f,
                                                    .rate_gain = 0.5f,
                                                    .bias_gain = 0.125f,
                                                    .bias_limit = 1.0f,
                                                    .position_gate = 30.0f,
                                                    .velocity_gate = 20.0f,
                                                    .late_steps = 10u,
                                                    .lost_steps = 100u,
                                                    .settle_fixes = 1u,
                                                    .jump_fixes = 3u},
                                           .accuracy = 5.0f,
                                           .speed_accuracy = 1.0f};
    keel_position_t model;

    memset(&model, 0, sizeof model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        const keel_position_sample_t measured = any_sample();

        if ((i % 2048u) == 0u) {
            TEST_ASSERT_EQUAL(KEEL_OK, keel_position_init(&position, &config));
            TEST_ASSERT_EQUAL(KEEL_OK, model_position_init(&model, &config));
        }
        if (((i % 2048u) == 64u) || one_in(2048u)) {
            const int32_t longitude = one_in(8u) ? (int32_t)any() : 1799999000;
            const keel_status_t status = model_position_set_origin(&model, 481000000, longitude);

            TEST_ASSERT_EQUAL(status, keel_position_set_origin(&position, 481000000, longitude));
        }
        keel_position_step(&position, &measured);
        model_position_step(&model, &measured);
        TEST_ASSERT_EQUAL_MEMORY(&model, &position, sizeof position);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(POS_007_every_step_is_the_specified_one);
    return UNITY_END();
}
