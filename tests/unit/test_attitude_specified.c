/* SPDX-License-Identifier: Apache-2.0 */
/* The attitude estimator beside its executable specification (specs/model): random and adversarial
 * samples to both, after each of which every bit of the estimator must be the same; and, in double
 * precision, within its bounds. */
#include "any.h"
#include "keel/flight/attitude.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/attitude.c"

#define STEPS       1000000u
#define SETUP_EVERY 4096u
#define SEED        20241123u

static keel_attitude_t attitude;
static keel_attitude_t model;

void setUp(void)
{
    any_from(SEED);
    memset(&attitude, 0, sizeof attitude);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,     INFINITY, -INFINITY, 0.0f,       -0.0f,      0x1p-149f,
                            FLT_MAX, -FLT_MAX, 1.0e6f,    any_bits(), any_bits(), 40.0f};

    return values[any() % (sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(512u) ? awkward() : value;
}

static keel_attitude_vector_t about(float x, float y, float z, float noise)
{
    const keel_attitude_vector_t v = {usually(x + between(-noise, noise)),
                                      usually(y + between(-noise, noise)),
                                      usually(z + between(-noise, noise))};

    return v;
}

/* Mostly good ones: whether a configuration is taken is the model's to say, too. */
static void set_up(void)
{
    const keel_attitude_config_t config = {.rate_hz = usually(between(500.0f, 2000.0f)),
                                           .tilt_gain = between(0.0f, 8.0f),
                                           .heading_gain = between(0.0f, 8.0f),
                                           .align_gain = usually(8.0f),
                                           .bias_gain = between(0.0f, 8.0f),
                                           .force_gain = between(0.0f, 8.0f),
                                           .field_share = usually(between(0.0f, 1.0f)),
                                           .bias_limit = usually(between(0.0f, 0.5f)),
                                           .quiet_rate = 0.5f,
                                           .clip_rate = usually(32.0f),
                                           .still_rate = 0.25f,
                                           .still_acceleration = 1.0f,
                                           .tolerance = between(0.0f, 1.0f),
                                           .north = usually(between(-2.0f, 2.0f)),
                                           .east = between(-2.0f, 2.0f),
                                           .still_steps = (uint16_t)(any() % 32u),
                                           .settle_steps = (uint16_t)(1u + (any() % 16u)),
                                           .lost_steps = (uint16_t)(1u + (any() % 16u)),
                                           .field_steps = (uint16_t)(1u + (any() % 64u))};
    const keel_status_t expected = model_attitude_init(&model, &config);

    TEST_ASSERT_EQUAL(expected, keel_attitude_init(&attitude, &config));
}

/* Level, or turned over now and then, with the field ahead. */
static keel_attitude_sample_t any_sample(uint32_t step)
{
    const float up = ((step / 8192u) % 4u == 3u) ? -9.8f : 9.8f;
    const float rate = one_in(64u) ? 45.0f : 0.1f;
    const keel_attitude_sample_t sample = {
        .gyroscope = about(0.01f, 0.0f, 0.0f, rate),
        .accelerometer = about(0.0f, 0.0f, -up, 0.25f),
        .magnetometer = about(attitude.config.north, attitude.config.east, 0.5f, 0.25f),
        .acceleration = about(0.0f, 0.0f, 0.0f, 0.5f),
        .has_gyroscope = !one_in(32u),
        .has_accelerometer = !one_in(32u),
        .has_magnetometer = one_in(4u),
        .has_acceleration = one_in(2u)};

    return sample;
}

static bool is_near(keel_attitude_vector_t v, float most)
{
    return (fabsf(v.x) <= most) && (fabsf(v.y) <= most) && (fabsf(v.z) <= most);
}

/* The bounds of ATT-010, unless the step began with a quaternion that is none; and of ATT-011. */
static void is_bounded(bool corrupted)
{
    const keel_attitude_quaternion_t q = attitude.quaternion;
    const double square = ((double)q.w * q.w) + ((double)q.x * q.x) + ((double)q.y * q.y) +
                          ((double)q.z * q.z);

    TEST_ASSERT_TRUE(square >= (corrupted ? (1.0 - 2.45e-4) : (1.0 - 1.30e-4)));
    TEST_ASSERT_TRUE(square <= (corrupted ? (1.0 + 2.45e-4) : (1.0 + 7.7e-6)));
    TEST_ASSERT_TRUE(is_near(attitude.bias, attitude.config.bias_limit));
    TEST_ASSERT_TRUE(is_near(attitude.rate, 40.5f));
    TEST_ASSERT_TRUE(is_near(attitude.down, 16.0f));
    TEST_ASSERT_TRUE(is_near(attitude.field, 4096.0f));
    TEST_ASSERT_TRUE(is_near(attitude.sum, 65535.0f));
    TEST_ASSERT_TRUE(fabsf(attitude.heading_error) <= 1.25f);
}

static void ATT_009_every_step_is_the_specified_one(void)
{
    uint32_t seen[4] = {0u};
    uint32_t told = 0u;

    set_up();
    for (uint32_t i = 0u; i < STEPS; i++) {
        const keel_attitude_sample_t sample = any_sample(i);
        const bool corrupted = one_in(1024u);

        if ((i % SETUP_EVERY) == 0u) {
            set_up();
        }
        if (corrupted) {
            attitude.quaternion.x = awkward();
            model.quaternion.x = attitude.quaternion.x;
        }
        keel_attitude_step(&attitude, &sample);
        model_attitude_step(&model, &sample);
        TEST_ASSERT_EQUAL_MEMORY(&model, &attitude, sizeof attitude);
        is_bounded(corrupted);
        seen[attitude.phase]++;
        seen[3] += attitude.heading_valid ? 1u : 0u;
        told |= attitude.flags;
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, seen[i]);
    }
    TEST_ASSERT_EQUAL_HEX32(0x7Fu, told);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ATT_009_every_step_is_the_specified_one);
    return UNITY_END();
}
