/* SPDX-License-Identifier: Apache-2.0 */
/* Voter, filter, PID and reference generator beside their executable specification (specs/model):
 * random and adversarial calls on both, of which result and every bit of the object must be the
 * same after each. */
#include "any.h"
#include "keel/flight/filter.h"
#include "keel/flight/pid.h"
#include "keel/flight/reference.h"
#include "keel/middleware/voter.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/filter.c"
#include "../../specs/model/pid.c"
#include "../../specs/model/range.c"
#include "../../specs/model/reference.c"
#include "../../specs/model/voter.c"
#include "../../specs/model/voter_parts.c"

/* tools/keel soak asks for more of them, from elsewhere. */
#ifndef STEPS
#define STEPS 1000000u
#endif
#ifndef SEED
#define SEED 20240607u
#endif
#define SMALLEST    0x1p-149f /* Above 0, and not normal. */
#define SETUP_EVERY 256u

void setUp(void)
{
    any_from(SEED);
}

void tearDown(void)
{
}

static uint32_t below(uint32_t limit)
{
    return any() % limit;
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,      INFINITY, -INFINITY, 0.0f,       -0.0f,      SMALLEST,
                            -FLT_MIN, FLT_MAX,  -FLT_MAX,  -SMALLEST,  1.0e6f,     -1.0e6f,
                            1.0e9f,   5.0e5f,   -5.0e5f,   any_bits(), any_bits(), 1.0f};

    return values[below(sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(64u) ? awkward() : value;
}

static keel_voter_t voter;
static keel_voter_t voter_model;
static bool voter_made;

static void set_up_voter(void)
{
    const float limit = one_in(4u) ? 4.0f : 1000.0f;
    const keel_voter_config_t config = {.agree = usually(between(0.001f, 4.0f)),
                                        .cutoff = usually(between(1.01f, 6.0f)),
                                        .slope = usually(one_in(2u) ? 0.0f : between(0.0f, 0.1f)),
                                        .lowest = usually(-limit),
                                        .highest = usually(one_in(8u) ? 0.0f : limit),
                                        .initial = usually(0.0f),
                                        .max_age_us = one_in(64u) ? 0u : 100u,
                                        .latch_count = (uint16_t)below(64u),
                                        .stale_count = (uint16_t)below(16u),
                                        .readmit_count = (uint16_t)below(8u),
                                        .density_limit = (uint16_t)below(128u),
                                        .sensors = (uint8_t)(one_in(64u) ? any() : 2u + below(3u))};
    const keel_status_t expected = model_voter_init(&voter_model, &config);

    TEST_ASSERT_EQUAL(model_voter_check(&config), keel_voter_check(&config));
    TEST_ASSERT_EQUAL(expected, keel_voter_init(&voter, &config));
    voter_made = voter_made || (expected == KEEL_OK);
}

/* A sample near the truth, the last one, its opposite (0 and -0), or one that is awkward. */
static float any_value(float truth, const keel_voter_sensor_t *sensor, bool rests)
{
    const float value = truth + (between(-0.6f, 0.6f) * voter.config.agree);

    if (one_in(64u)) {
        return one_in(2u) ? awkward() : -sensor->last;
    }
    return (rests || one_in(16u)) ? sensor->last : value;
}

static bool any_samples(keel_voter_sample_t sample[KEEL_VOTER_SENSORS])
{
    const float truth = one_in(16u) ? 0.0f : between(-5.0f, 5.0f);
    const bool rests = one_in(8u);
    const bool zeros = one_in(32u);
    bool complete = true;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        sample[i].value = any_value(truth, &voter.sensor[i], rests);
        sample[i].value = zeros ? (one_in(4u) ? 0.0f : -0.0f) : sample[i].value;
        sample[i].age_us = one_in(64u) ? any() : below(101u);
        sample[i].present = !one_in(128u);
        complete = complete && sample[i].present;
    }
    return complete;
}

static uint32_t oldest_of(const keel_voter_sample_t sample[KEEL_VOTER_SENSORS])
{
    uint32_t oldest_us = 0u;

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        oldest_us = (sample[i].age_us > oldest_us) ? sample[i].age_us : oldest_us;
    }
    return oldest_us;
}

/* VOT-018: what is taken is what the whole vote leaves, too. */
static bool attempt(const keel_voter_sample_t sample[KEEL_VOTER_SENSORS])
{
    const uint32_t oldest_us = oldest_of(sample);
    const bool expected = model_voter_step_unanimous(&voter_model, sample, oldest_us);
    keel_voter_t whole;

    memcpy(&whole, &voter, sizeof whole);
    TEST_ASSERT_EQUAL(expected, keel_voter_step_unanimous(&voter, sample, oldest_us));
    if (expected) {
        keel_voter_step(&whole, sample, 0u);
        TEST_ASSERT_EQUAL_MEMORY(&whole, &voter, sizeof voter);
    }
    return expected;
}

static void VOT_018_every_vote_is_the_specified_one(void)
{
    uint32_t taken = 0u;
    uint32_t readmitted = 0u;

    memset(&voter, 0, sizeof voter);
    memset(&voter_model, 0, sizeof voter_model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        keel_voter_sample_t sample[KEEL_VOTER_SENSORS];
        bool complete;

        if ((i % SETUP_EVERY) == 0u) {
            set_up_voter();
        }
        complete = any_samples(sample);
        if (voter_made) {
            model_voter_scale(&voter_model);
            keel_voter_scale(&voter);
        }
        if (voter_made && complete && attempt(sample)) {
            taken++;
        } else if (voter_made) {
            const uint32_t elapsed_us = any();

            model_voter_step(&voter_model, sample, elapsed_us);
            keel_voter_step(&voter, sample, elapsed_us);
        }
        if (voter_made && !one_in(8u)) {
            model_voter_reconsider(&voter_model, sample);
            keel_voter_reconsider(&voter, sample);
        }
        if (voter_made && one_in(32u)) {
            const uint32_t sensor = below(KEEL_VOTER_SENSORS + 1u);
            const keel_status_t expected = model_voter_readmit(&voter_model, sensor);

            TEST_ASSERT_EQUAL(expected, keel_voter_readmit(&voter, sensor));
            readmitted += (expected == KEEL_OK) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_MEMORY(&voter_model, &voter, sizeof voter);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 20u, taken);
    TEST_ASSERT_GREATER_THAN_UINT32(100u, readmitted);
}

static keel_filter_t filter;
static keel_filter_t filter_model;

static void FLT_009_every_step_is_the_specified_one(void)
{
    bool made = false;
    uint32_t refused = 0u;

    memset(&filter, 0, sizeof filter);
    memset(&filter_model, 0, sizeof filter_model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        const float input = usually(between(-1.0e6f, 1.0e6f));

        if ((i % SETUP_EVERY) == 0u) {
            const float rate_hz = usually(between(1.0f, 8000.0f));
            const float cutoff_hz = usually(between(0.1f, 0.6f * rate_hz));
            const keel_status_t expected = model_filter_init(&filter_model, rate_hz, cutoff_hz);

            TEST_ASSERT_EQUAL(expected, keel_filter_init(&filter, rate_hz, cutoff_hz));
            made = made || (expected == KEEL_OK);
        }
        if (made && one_in(128u)) {
            TEST_ASSERT_EQUAL(model_filter_reset(&filter_model, input),
                              keel_filter_reset(&filter, input));
        } else if (made) {
            const keel_status_t expected = model_filter_step(&filter_model, input);

            TEST_ASSERT_EQUAL(expected, keel_filter_step(&filter, input));
            refused += (expected != KEEL_OK) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_MEMORY(&filter_model, &filter, sizeof filter);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(1000u, refused);
}

static keel_pid_t pid;
static keel_pid_t pid_model;

static keel_pid_gains_t any_gains(void)
{
    return (keel_pid_gains_t){.kp = usually(between(0.0f, 10.0f)),
                              .ki = usually(between(0.0f, 10.0f)),
                              .kd = usually(between(0.0f, 1.0f)),
                              .kff = usually(between(0.0f, 1.0f))};
}

static bool set_up_pid(void)
{
    const keel_pid_config_t config = {.gains = any_gains(),
                                      .rate_hz = usually(between(100.0f, 8000.0f)),
                                      .cutoff_hz = usually(between(1.0f, 60.0f)),
                                      .output_min = usually(between(-900.0f, 0.0f)),
                                      .output_max = usually(between(1.0f, 900.0f)),
                                      .integral_min = usually(between(-90.0f, 0.0f)),
                                      .integral_max = usually(between(0.0f, 90.0f))};
    const keel_status_t expected = model_pid_init(&pid_model, &config);

    TEST_ASSERT_EQUAL(expected, keel_pid_init(&pid, &config));
    return expected == KEEL_OK;
}

static void PID_008_every_step_is_the_specified_one(void)
{
    bool made = false;
    uint32_t saturated = 0u;

    memset(&pid, 0, sizeof pid);
    memset(&pid_model, 0, sizeof pid_model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        if ((i % SETUP_EVERY) == 0u) {
            made = set_up_pid() || made;
        }
        if (made && one_in(128u)) {
            const keel_pid_gains_t gains = any_gains();

            TEST_ASSERT_EQUAL(model_pid_set_gains(&pid_model, &gains),
                              keel_pid_set_gains(&pid, &gains));
        } else if (made && one_in(128u)) {
            model_pid_reset(&pid_model);
            keel_pid_reset(&pid);
        } else if (made) {
            const float setpoint = usually(between(-100.0f, 100.0f));
            const float measurement = usually(between(-100.0f, 100.0f));

            TEST_ASSERT_EQUAL(model_pid_step(&pid_model, setpoint, measurement),
                              keel_pid_step(&pid, setpoint, measurement));
        }
        TEST_ASSERT_EQUAL_MEMORY(&pid_model, &pid, sizeof pid);
        saturated += (pid.saturation != KEEL_PID_FREE) ? 1u : 0u;
    }
    TEST_ASSERT_GREATER_THAN_UINT32(1000u, saturated);
}

static keel_reference_t reference;
static keel_reference_t reference_model;

static keel_reference_shape_t any_shape(void)
{
    return (keel_reference_shape_t){.dead_band = usually(between(0.001f, 0.5f)),
                                    .expo = usually(between(0.0f, 1.0f))};
}

static bool set_up_reference(void)
{
    const keel_reference_config_t config = {.roll = any_shape(),
                                            .pitch = any_shape(),
                                            .yaw = any_shape(),
                                            .climb = any_shape(),
                                            .limits = {.roll_rate = between(0.1f, 64.0f),
                                                       .pitch_rate = between(0.1f, 64.0f),
                                                       .yaw_rate = between(0.1f, 64.0f),
                                                       .heading_rate = between(0.1f, 64.0f),
                                                       .tilt = usually(between(0.1f, 1.5f)),
                                                       .speed = usually(between(0.1f, 99.0f)),
                                                       .climb_rate = between(0.1f, 100.0f),
                                                       .descent_rate = between(0.1f, 100.0f)}};
    const keel_status_t expected = model_reference_init(&reference_model, &config);

    TEST_ASSERT_EQUAL(expected, keel_reference_init(&reference, &config));
    return expected == KEEL_OK;
}

static void REF_005_every_step_is_the_specified_one(void)
{
    bool made = false;
    uint32_t refused = 0u;

    memset(&reference, 0, sizeof reference);
    memset(&reference_model, 0, sizeof reference_model);
    for (uint32_t i = 0u; i < STEPS; i++) {
        if ((i % SETUP_EVERY) == 0u) {
            made = set_up_reference() || made;
        }
        if (made) {
            const keel_reference_sticks_t sticks = {.roll = usually(between(-1.0f, 1.0f)),
                                                    .pitch = usually(between(-1.0f, 1.0f)),
                                                    .yaw = usually(between(-1.0f, 1.0f)),
                                                    .climb = usually(between(-1.0f, 1.0f))};
            const keel_status_t expected = model_reference_step(&reference_model, &sticks);

            TEST_ASSERT_EQUAL(expected, keel_reference_step(&reference, &sticks));
            refused += (expected != KEEL_OK) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_MEMORY(&reference_model, &reference, sizeof reference);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(1000u, refused);
    TEST_ASSERT_LESS_THAN_UINT32(STEPS / 2u, refused);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(VOT_018_every_vote_is_the_specified_one);
    RUN_TEST(FLT_009_every_step_is_the_specified_one);
    RUN_TEST(PID_008_every_step_is_the_specified_one);
    RUN_TEST(REF_005_every_step_is_the_specified_one);
    return UNITY_END();
}
