/* SPDX-License-Identifier: Apache-2.0 */
/* An axis beside its executable specification (specs/model): random and adversarial samples to
 * both, after each of which every bit of the axis must be the same, and within its bounds. */
#include "any.h"
#include "keel/flight/axis.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/axis.c"

#define STEPS       1000000u
#define SETUP_EVERY 4096u
#define SEED        20261123u

static keel_axis_t axis;
static keel_axis_t model;

void setUp(void)
{
    any_from(SEED);
    memset(&axis, 0, sizeof axis);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,     INFINITY, -INFINITY, 0.0f,       -0.0f,      0x1p-149f,
                            FLT_MAX, -FLT_MAX, 16384.0f,  any_bits(), any_bits(), -320.0f};

    return values[any() % (sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(256u) ? awkward() : value;
}

/* Mostly good ones: whether a configuration is taken is the model's to say, too. */
static void set_up(void)
{
    const keel_axis_config_t config = {.rate_hz = usually(between(10.0f, 1000.0f)),
                                       .position_gain = usually(between(0.0f, 1.0f)),
                                       .velocity_gain = usually(between(0.0f, 4.0f)),
                                       .rate_gain = usually(between(0.0f, 1.0f)),
                                       .bias_gain = usually(between(0.0f, 1.0f)),
                                       .bias_limit = usually(between(0.0f, 2.0f)),
                                       .position_gate = usually(between(5.0f, 50.0f)),
                                       .velocity_gate = usually(between(2.0f, 20.0f)),
                                       .late_steps = (uint16_t)(any() % 32u),
                                       .lost_steps = (uint16_t)(16u + (any() % 64u)),
                                       .settle_fixes = (uint16_t)(any() % 8u),
                                       .jump_fixes = (uint16_t)(any() % 8u)};
    const keel_status_t expected = model_axis_init(&model, &config);

    TEST_ASSERT_EQUAL(expected, keel_axis_init(&axis, &config));
}

static keel_axis_sample_t any_sample(void)
{
    const float wide = one_in(16u) ? 100.0f : 1.0f;
    const keel_axis_sample_t sample = {.acceleration = usually(between(-10.0f, 10.0f)),
                                       .position = usually(axis.position + between(-wide, wide)),
                                       .velocity = usually(axis.velocity + between(-wide, wide)),
                                       .has_acceleration = !one_in(32u),
                                       .has_fix = one_in(one_in(64u) ? 100u : 5u),
                                       .has_velocity = one_in(2u),
                                       .is_usable = !one_in(32u)};

    return sample;
}

static void AXI_004_every_step_is_the_specified_one(void)
{
    uint32_t seen[3] = {0u};
    uint32_t told = 0u;

    set_up();
    for (uint32_t i = 0u; i < STEPS; i++) {
        const keel_axis_sample_t sample = any_sample();

        if ((i % SETUP_EVERY) == 0u) {
            set_up();
        }
        keel_axis_step(&axis, &sample);
        model_axis_step(&model, &sample);
        TEST_ASSERT_EQUAL_MEMORY(&model, &axis, sizeof axis);
        TEST_ASSERT_TRUE(fabsf(axis.position) <= 16384.0f);
        TEST_ASSERT_TRUE(fabsf(axis.velocity) <= 256.0f);
        TEST_ASSERT_TRUE(fabsf(axis.bias) <= axis.config.bias_limit);
        seen[axis.quality]++;
        told |= axis.flags;
    }
    for (uint32_t i = 0u; i < 3u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 500u, seen[i]);
    }
    TEST_ASSERT_EQUAL_HEX32(0x3Fu, told);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(AXI_004_every_step_is_the_specified_one);
    return UNITY_END();
}
