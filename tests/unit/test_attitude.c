/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/attitude.h. Expected values are worked out by hand, at 1000 Hz, where
 * a rate of w rad/s turns by half an angle of w / 2000 in a step. How it does in motion is in
 * test_attitude_motion.c. */
#include "keel/internal/flight/attitude.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define G 9.80665f

static const keel_attitude_config_t usual = {.rate_hz = 1000.0f,
                                             .tilt_gain = 0.5f,
                                             .heading_gain = 0.25f,
                                             .align_gain = 8.0f,
                                             .bias_gain = 1.0f,
                                             .force_gain = 8.0f,
                                             .field_share = 1.0f,
                                             .bias_limit = 0.25f,
                                             .quiet_rate = 0.5f,
                                             .clip_rate = 32.0f,
                                             .still_rate = 0.25f,
                                             .still_acceleration = 0.5f,
                                             .tolerance = 0.125f,
                                             .north = 1.0f,
                                             .east = 0.0f,
                                             .still_steps = 4u,
                                             .settle_steps = 2u,
                                             .lost_steps = 3u,
                                             .field_steps = 5u};

/* At rest, level, heading north; without a field. */
static const keel_attitude_sample_t rest = {.accelerometer = {0.0f, 0.0f, -G},
                                            .magnetometer = {1.0f, 0.0f, 2.0f},
                                            .has_gyroscope = true,
                                            .has_accelerometer = true};

static keel_attitude_config_t config;
static keel_attitude_sample_t sample;
static keel_attitude_t attitude;

/* All of a low pass: a share of 1, as no configuration has it. A measurement counts at once. */
static void pass_all(void)
{
    attitude.scale.step = 0.125f;
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_attitude_init(&attitude, &config));
    pass_all();
}

void setUp(void)
{
    config = usual;
    sample = rest;
    memset(&attitude, 0x55, sizeof attitude);
    make();
}

void tearDown(void)
{
}

/* One of a vector's parts. */
static float *axis_of(keel_attitude_vector_t *v, uint32_t axis)
{
    float *const parts[] = {&v->x, &v->y, &v->z};

    return parts[axis];
}

/* +1 and -1 on each axis in turn. */
#define WAYS 6u

static uint32_t axis_at(uint32_t n)
{
    return n / 2u;
}

static float sign_at(uint32_t n)
{
    return ((n % 2u) == 0u) ? 1.0f : -1.0f;
}

static void step(void)
{
    keel_attitude_step(&attitude, &sample);
}

static void steps(uint32_t n)
{
    for (; n > 0u; n--) {
        step();
    }
}

/* Level, with a bias of 0: four still samples, two that agree. */
static void run(void)
{
    sample = rest;
    steps(6u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
}

static void run_with_heading(void)
{
    run();
    sample.has_magnetometer = true;
    steps(2u);
    TEST_ASSERT_TRUE(attitude.heading_valid);
}

static void vector_is(float x, float y, float z, keel_attitude_vector_t v)
{
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, x, v.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, y, v.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-7f, z, v.z);
}

/* Turned from level by these half angles, all small. */
static void turned_by(float x, float y, float z)
{
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, x, attitude.quaternion.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, y, attitude.quaternion.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, z, attitude.quaternion.z);
}

static void flags_are(uint32_t expected)
{
    TEST_ASSERT_EQUAL_HEX32(expected, attitude.flags);
}

static void refused(keel_status_t status)
{
    keel_attitude_t before;

    memcpy(&before, &attitude, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_attitude_init(&attitude, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &attitude, sizeof attitude);
    config = usual;
}

/* NaN, just outside both ends, and both ends. */
static void bounded_by(float *field, float least, float most, keel_status_t status)
{
    const float outside[] = {NAN, nextafterf(least, -1.0e9f), nextafterf(most, 1.0e9f), INFINITY};
    const float inside[] = {least, most};
    const keel_attitude_config_t before = config;

    for (size_t i = 0u; i < (sizeof outside / sizeof outside[0]); i++) {
        config = before;
        *field = outside[i];
        refused(status);
    }
    for (size_t i = 0u; i < (sizeof inside / sizeof inside[0]); i++) {
        config = before;
        *field = inside[i];
        make();
    }
    config = usual;
}

static void ATT_001_bad_rates_are_refused(void)
{
    bounded_by(&config.rate_hz, 500.0f, 32000.0f, KEEL_ERR_RATE);
}

static void ATT_001_bad_gains_are_refused(void)
{
    bounded_by(&config.tilt_gain, 0.0f, 8.0f, KEEL_ERR_GAIN);
    bounded_by(&config.heading_gain, 0.0f, 8.0f, KEEL_ERR_GAIN);
    bounded_by(&config.align_gain, 0.0f, 8.0f, KEEL_ERR_GAIN);
    bounded_by(&config.bias_gain, 0.0f, 8.0f, KEEL_ERR_GAIN);
    bounded_by(&config.force_gain, 0.0f, 8.0f, KEEL_ERR_GAIN);
    bounded_by(&config.field_share, 0.0f, 1.0f, KEEL_ERR_GAIN);
}

static void ATT_001_bad_limits_are_refused(void)
{
    bounded_by(&config.bias_limit, 0.0f, 0.5f, KEEL_ERR_LIMITS);
    bounded_by(&config.clip_rate, 0.5f, 40.0f, KEEL_ERR_LIMITS); /* Not below quiet_rate. */
    bounded_by(&config.quiet_rate, 0.0f, 32.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.still_rate, 0.0f, 1.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.still_acceleration, 0.0f, 10.0f, KEEL_ERR_LIMITS);
    bounded_by(&config.tolerance, 0.0f, 1.0f, KEEL_ERR_LIMITS);
}

static void ATT_001_no_steps_are_refused(void)
{
    config.still_steps = 0u;
    refused(KEEL_ERR_LIMITS);
    config.settle_steps = 0u;
    refused(KEEL_ERR_LIMITS);
    config.lost_steps = 0u;
    refused(KEEL_ERR_LIMITS);
    config.field_steps = 0u;
    refused(KEEL_ERR_LIMITS);
}

static void ATT_001_bad_fields_are_refused(void)
{
    const float bad[][2] = {{NAN, 1.0f},      {1.0f, NAN},      {1000.5f, 0.0f},
                            {-1000.5f, 0.0f}, {0.0f, -1000.5f}, {0.0f, 1000.5f},
                            {0.0f, 0.06f},    {0.04f, 0.04f},   {INFINITY, 0.0f}};
    const float good[][2] = {{0.0f, 0.0f}, {0.0625f, 0.0f}, {-1000.0f, 1000.0f}, {0.05f, 0.05f}};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        config.north = bad[i][0];
        config.east = bad[i][1];
        refused(KEEL_ERR_INPUT);
    }
    for (size_t i = 0u; i < (sizeof good / sizeof good[0]); i++) {
        config.north = good[i][0];
        config.east = good[i][1];
        make();
    }
}

static void ATT_001_first_fault_is_told(void)
{
    config.rate_hz = 0.0f;
    config.tilt_gain = -1.0f;
    refused(KEEL_ERR_RATE);
    config.tilt_gain = -1.0f;
    config.tolerance = 2.0f;
    refused(KEEL_ERR_GAIN);
    config.tolerance = 2.0f;
    config.north = NAN;
    refused(KEEL_ERR_LIMITS);
}

static void ATT_002_what_follows_from_a_configuration(void)
{
    config.north = 3.0f;
    config.east = -4.0f;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_attitude_init(&attitude, &config));
    TEST_ASSERT_EQUAL_MEMORY(&config, &attitude.config, sizeof config);
    TEST_ASSERT_EQUAL_FLOAT(0.001f, attitude.scale.step);
    TEST_ASSERT_EQUAL_FLOAT(0.0005f, attitude.scale.half_step);
    TEST_ASSERT_EQUAL_FLOAT(0.001f, attitude.scale.bias_step);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, attitude.scale.quiet);
    TEST_ASSERT_EQUAL_FLOAT(0.015625f, attitude.scale.tolerance);
    TEST_ASSERT_EQUAL_FLOAT(0.12f, attitude.scale.north);
    TEST_ASSERT_EQUAL_FLOAT(-0.16f, attitude.scale.east);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, attitude.scale.still);
    config.north = 0.0f;
    config.east = 0.0f;
    make();
    TEST_ASSERT_EQUAL_FLOAT(0.0f, attitude.scale.north);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, attitude.scale.east);
}

static void is_new(void)
{
    TEST_ASSERT_EQUAL_FLOAT(1.0f, attitude.quaternion.w);
    turned_by(0.0f, 0.0f, 0.0f);
    vector_is(0.0f, 0.0f, 0.0f, attitude.bias);
    vector_is(0.0f, 0.0f, 0.0f, attitude.rate);
    vector_is(0.0f, 0.0f, 0.0f, attitude.gyroscope);
    vector_is(0.0f, 0.0f, 0.0f, attitude.down);
    vector_is(0.0f, 0.0f, 0.0f, attitude.field);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, attitude.heading_error);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
    TEST_ASSERT_FALSE(attitude.heading_valid);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.still);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.settled);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.heading_settled);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.lost);
    TEST_ASSERT_EQUAL_UINT16(5u, attitude.field_age);
    flags_are(0u);
}

static void ATT_003_begins_level_and_not_valid(void)
{
    is_new();
}

static void ATT_003_a_restart_forgets(void)
{
    run_with_heading();
    sample.gyroscope.x = 1.0f;
    sample.magnetometer.y = 0.1f;
    steps(10u);
    sample.has_gyroscope = false;
    step();
    keel_attitude_restart(&attitude);
    is_new();
    TEST_ASSERT_EQUAL_MEMORY(&config, &attitude.config, sizeof config);
}

static void ATT_004_takes_what_the_vote_gave(void)
{
    keel_virtual_imu_t imu;

    memset(&imu, 0, sizeof imu);
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        imu.channel[k].vote.output = (float)k + 1.0f;
        imu.channel[k].vote.contributing = 2u;
    }
    sample.has_accelerometer = false;
    sample.has_gyroscope = false;
    sample.has_magnetometer = true;
    keel_attitude_take(&sample, &imu);
    vector_is(1.0f, 2.0f, 3.0f, sample.accelerometer);
    vector_is(4.0f, 5.0f, 6.0f, sample.gyroscope);
    vector_is(1.0f, 0.0f, 2.0f, sample.magnetometer);
    TEST_ASSERT_TRUE(sample.has_accelerometer);
    TEST_ASSERT_TRUE(sample.has_gyroscope);
    TEST_ASSERT_TRUE(sample.has_magnetometer);
    TEST_ASSERT_FALSE(sample.has_acceleration);
}

static void ATT_004_a_held_output_is_no_sample(void)
{
    keel_virtual_imu_t imu;

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        memset(&imu, 0, sizeof imu);
        for (uint32_t j = 0u; j < KEEL_VIRTUAL_IMU_CHANNELS; j++) {
            imu.channel[j].vote.contributing = (uint8_t)((j == k) ? 0u : 1u);
        }
        keel_attitude_take(&sample, &imu);
        TEST_ASSERT_EQUAL(k >= 3u, sample.has_accelerometer);
        TEST_ASSERT_EQUAL(k < 3u, sample.has_gyroscope);
    }
}

static void ATT_005_a_lost_rate_is_held_for_a_while(void)
{
    run();
    sample.gyroscope.x = 1.0f;
    sample.has_accelerometer = false;
    step();
    flags_are(0u);
    sample.has_gyroscope = false;
    sample.gyroscope.x = 5.0f;
    steps(2u);
    flags_are(KEEL_ATTITUDE_LOST);
    vector_is(1.0f, 0.0f, 0.0f, attitude.rate);
    turned_by(0.0015f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    step(); /* The third in a row: not valid, and not turning any more. */
    vector_is(0.0f, 0.0f, 0.0f, attitude.rate);
    turned_by(0.0015f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    TEST_ASSERT_EQUAL_UINT16(3u, attitude.lost);
    steps(100u);
    TEST_ASSERT_EQUAL_UINT16(3u, attitude.lost);
    turned_by(0.0015f, 0.0f, 0.0f);
}

static void ATT_005_one_good_rate_makes_up_for_one_lost(void)
{
    run();
    for (uint32_t n = 0u; n < 50u; n++) {
        sample.has_gyroscope = (n % 2u) != 0u;
        step();
    }
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.lost);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    for (uint32_t n = 0u; n < 7u; n++) {
        sample.has_gyroscope = (n % 3u) == 2u; /* Two lost, one good: 1 2 1 2 3. */
        step();
        TEST_ASSERT_EQUAL((n < 4u) ? KEEL_ATTITUDE_RUNNING : KEEL_ATTITUDE_ALIGNING,
                          attitude.phase);
    }
}

static void ATT_005_rates_that_cannot_be_are_lost(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 40.01f, -40.01f};

    run();
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        for (uint32_t axis = 0u; axis < 3u; axis++) {
            sample = rest;
            step();
            sample.gyroscope.x = (axis == 0u) ? bad[i] : 0.1f;
            sample.gyroscope.y = (axis == 1u) ? bad[i] : 0.1f;
            sample.gyroscope.z = (axis == 2u) ? bad[i] : 0.1f;
            step();
            TEST_ASSERT_EQUAL_HEX32(KEEL_ATTITUDE_LOST, attitude.flags & KEEL_ATTITUDE_LOST);
            vector_is(0.0f, 0.0f, 0.0f, attitude.gyroscope);
        }
    }
}

static void ATT_005_clipped_rates_are_used_and_told(void)
{
    run();
    sample.has_accelerometer = false;
    sample.gyroscope.y = 32.0f;
    step();
    flags_are(0u);
    sample.gyroscope.y = -40.0f;
    step();
    flags_are(KEEL_ATTITUDE_CLIPPED);
    vector_is(0.0f, -40.0f, 0.0f, attitude.rate);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    steps(2u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    steps(10u);
    TEST_ASSERT_EQUAL_UINT16(3u, attitude.lost);
    vector_is(0.0f, -40.0f, 0.0f, attitude.rate);
}

static void ATT_005_a_clipped_rate_about_any_axis(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        *axis_of(&sample.gyroscope, axis_at(n)) = sign_at(n) * 33.0f;
        step();
        flags_are(KEEL_ATTITUDE_CLIPPED | KEEL_ATTITUDE_DOWN);
        TEST_ASSERT_EQUAL_FLOAT(sign_at(n) * 33.0f, *axis_of(&attitude.rate, axis_at(n)));
    }
}

/* Rolled right by an angle of sine 0.6: down is (0, 0.6, 0.8) to the body. */
static void rolled(void)
{
    sample.accelerometer.y = -0.6f * G;
    sample.accelerometer.z = -0.8f * G;
}

static void ATT_006_rolls_towards_down(void)
{
    rolled();
    step();
    flags_are(KEEL_ATTITUDE_DOWN);
    turned_by(0.0024f, 0.0f, 0.0f); /* 8 x 0.6 rad/s */
    setUp();
    run();
    rolled();
    step();
    turned_by(0.00015f, 0.0f, 0.0f); /* 0.5 x 0.6 rad/s */
}

/* Nose up: down is (-0.6, 0, 0.8) to the body. */
static void ATT_006_pitches_towards_down(void)
{
    sample.accelerometer.x = 0.6f * G;
    sample.accelerometer.z = -0.8f * G;
    step();
    turned_by(0.0f, 0.0024f, 0.0f);
}

/* Beyond a right angle a nudge comes on top, 0.25 about x and 0.125 about y. */
static void ATT_006_upside_down_is_no_rest(void)
{
    sample.accelerometer.z = G;
    step();
    turned_by(0.001f, 0.0005f, 0.0f);
    setUp();
    sample.accelerometer.y = -G; /* At a right angle there is none. */
    sample.accelerometer.z = 0.0f;
    step();
    turned_by(0.004f, 0.0f, 0.0f);
}

static void down_is_taken(bool taken)
{
    step();
    TEST_ASSERT_EQUAL(taken, (attitude.flags & KEEL_ATTITUDE_DOWN) != 0u);
}

static void ATT_006_only_about_1_g_is_gravity(void)
{
    const float taken[] = {0.85f, 1.0f, 1.148f};
    const float ignored[] = {0.0f, 0.84f, 1.15f, 2.0f, 33.0f, 1.0e30f, NAN, INFINITY};

    for (size_t i = 0u; i < (sizeof taken / sizeof taken[0]); i++) {
        sample.accelerometer.z = -taken[i] * G;
        down_is_taken(true);
    }
    for (size_t i = 0u; i < (sizeof ignored / sizeof ignored[0]); i++) {
        sample.accelerometer.z = -ignored[i] * G;
        down_is_taken(false);
    }
    sample = rest;
    sample.has_accelerometer = false;
    down_is_taken(false);
}

static void ATT_006_gravity_is_measured_in_fast_turns(void)
{
    sample.gyroscope.x = 20.0f;
    sample.gyroscope.z = -30.0f;
    down_is_taken(true);
}

static void ATT_006_a_force_beyond_the_limit_on_any_axis(void)
{
    run();
    for (uint32_t n = 0u; n < WAYS; n++) {
        const keel_attitude_vector_t before = attitude.down;

        sample = rest;
        *axis_of(&sample.accelerometer, axis_at(n)) = sign_at(n) * 320.5f;
        down_is_taken(false);
        TEST_ASSERT_EQUAL_MEMORY(&before, &attitude.down, sizeof before);
    }
}

/* While aligning, and while running, where it contradicts: the nudge comes on top, too. */
static void ATT_006_upside_down_is_no_rest_later(void)
{
    steps(4u);
    sample.accelerometer.z = G;
    step();
    turned_by(0.001f, 0.0005f, 0.0f); /* 8 x (0.25, 0.125) rad/s */
    setUp();
    run();
    sample.accelerometer.z = G;
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    turned_by(0.0000625f, 0.00003125f, 0.0f); /* 0.5 x the same */
    step();                                   /* The second contradicts as often as two agreed. */
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    setUp();
    run();
    sample.accelerometer.z = G;
    sample.has_gyroscope = false; /* A lost rate does not change it. */
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    turned_by(0.0000625f, 0.00003125f, 0.0f);
}

/* 3 m/s^2 to the north, nose north: the body feels (3, 0, -g). */
static void ATT_007_acceleration_is_taken_off(void)
{
    sample.accelerometer.x = 3.0f;
    sample.acceleration.x = 3.0f;
    step();
    flags_are(KEEL_ATTITUDE_DOWN);
    turned_by(0.0f, 0.0012237f, 0.0f); /* 8 x 3 / g rad/s */
    setUp();
    sample.accelerometer.x = 3.0f;
    sample.acceleration.x = 3.0f;
    sample.has_acceleration = true;
    step();
    flags_are(KEEL_ATTITUDE_DOWN | KEEL_ATTITUDE_COMPENSATED);
    turned_by(0.0f, 0.0f, 0.0f);
}

/* Nose east: 3 m/s^2 to the east and 2 down are (3, 0, 2 - g) to the body, and 1 to the south is
 * 1 to the right. */
static void ATT_007_acceleration_is_the_earths(void)
{
    attitude.quaternion.w = 0.70710678f;
    attitude.quaternion.z = 0.70710678f;
    sample.accelerometer.x = 3.0f;
    sample.accelerometer.y = 1.0f;
    sample.accelerometer.z = 2.0f - G;
    sample.acceleration.x = -1.0f;
    sample.acceleration.y = 3.0f;
    sample.acceleration.z = 2.0f;
    sample.has_acceleration = true;
    step();
    flags_are(KEEL_ATTITUDE_DOWN | KEEL_ATTITUDE_COMPENSATED);
    turned_by(0.0f, 0.0f, 0.70710678f);
}

static void ATT_007_acceleration_that_cannot_be_is_ignored(void)
{
    const float bad[] = {NAN, INFINITY, 320.5f, -320.5f};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        sample.has_acceleration = true;
        sample.acceleration.z = bad[i];
        step();
        flags_are(KEEL_ATTITUDE_DOWN);
    }
}

static void ATT_007_acceleration_beyond_the_limit_on_any_axis(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        sample.has_acceleration = true;
        *axis_of(&sample.acceleration, axis_at(n)) = sign_at(n) * 320.5f;
        step();
        flags_are(KEEL_ATTITUDE_DOWN);
        *axis_of(&sample.acceleration, axis_at(n)) = sign_at(n) * 320.0f;
        step();
        flags_are(KEEL_ATTITUDE_COMPENSATED);
    }
}

/* Turned right by an angle of sine 0.6: the field comes from the left. */
static void ATT_008_turns_to_the_heading(void)
{
    sample.has_magnetometer = true;
    sample.magnetometer.x = 0.8f;
    sample.magnetometer.y = -0.6f;
    step();
    flags_are(KEEL_ATTITUDE_DOWN | KEEL_ATTITUDE_FIELD);
    TEST_ASSERT_EQUAL_FLOAT(0.6f, attitude.heading_error);
    turned_by(0.0f, 0.0f, 0.0024f);
    setUp();
    run_with_heading();
    sample.magnetometer.x = 0.8f;
    sample.magnetometer.y = -0.6f;
    step();
    turned_by(0.0f, 0.0f, 0.000075f); /* 0.25 x 0.6 rad/s */
}

/* The expected field is 3 north and 4 east; to a body with nose east that is (4, -3). */
static void ATT_008_declination(void)
{
    config.north = 3.0f;
    config.east = 4.0f;
    make();
    sample.has_magnetometer = true;
    sample.magnetometer.x = 3.0f;
    sample.magnetometer.y = 4.0f;
    step();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, attitude.heading_error);
    sample.magnetometer.x = 4.0f;
    sample.magnetometer.y = -3.0f;
    step();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, attitude.heading_error);
}

static void error_is(float expected, float x, float y)
{
    sample.magnetometer.x = x;
    sample.magnetometer.y = y;
    keel_attitude_restart(&attitude);
    step();
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, expected, attitude.heading_error);
}

static void ATT_008_beyond_a_right_angle_the_error_is_full(void)
{
    sample.has_magnetometer = true;
    error_is(0.99f, 0.01f, -0.99f);
    error_is(1.0f, -0.01f, -0.5f - 0.3f);
    error_is(-1.0f, -0.6f, 0.8f);
    error_is(1.0f, -1.0f, 0.0f);
    error_is(1.0f, 0.0f, -0.9f);
}

static void field_is_taken(bool taken)
{
    keel_attitude_restart(&attitude);
    step();
    TEST_ASSERT_EQUAL(taken, (attitude.flags & KEEL_ATTITUDE_FIELD) != 0u);
}

static void ATT_008_other_fields_are_ignored(void)
{
    const float taken[] = {0.71f, 1.0f, 1.22f};
    const float ignored[] = {0.0f, 0.70f, 1.23f, 50.0f, 1000.5f, NAN, INFINITY};

    sample.has_magnetometer = true;
    for (size_t i = 0u; i < (sizeof taken / sizeof taken[0]); i++) {
        sample.magnetometer.x = taken[i];
        field_is_taken(true);
    }
    for (size_t i = 0u; i < (sizeof ignored / sizeof ignored[0]); i++) {
        sample.magnetometer.x = ignored[i];
        field_is_taken(false);
    }
    sample = rest;
    field_is_taken(false);
    config.north = 0.0f; /* None is expected: none is taken. */
    make();
    sample.has_magnetometer = true;
    field_is_taken(false);
}

static void ATT_008_an_error_is_kept_for_five_steps(void)
{
    sample.has_magnetometer = true;
    sample.magnetometer.x = 0.8f;
    sample.magnetometer.y = -0.6f;
    step();
    sample.has_magnetometer = false;
    steps(4u);
    TEST_ASSERT_EQUAL_FLOAT(0.6f, attitude.heading_error);
    turned_by(0.0f, 0.0f, 0.012f);
    step();
    TEST_ASSERT_EQUAL_FLOAT(0.0f, attitude.heading_error);
    turned_by(0.0f, 0.0f, 0.012f);
    steps(100u);
    TEST_ASSERT_EQUAL_UINT16(5u, attitude.field_age);
}

/* About all axes at once, from a quaternion that has all components: (1 + i + j + k) / 2 times
 * 1 + 0.002 i + 0.004 j - 0.006 k, whose length is 1 but for 3e-5. */
static void ATT_009_turns_as_the_product_says(void)
{
    attitude.quaternion.w = 0.5f;
    attitude.quaternion.x = 0.5f;
    attitude.quaternion.y = 0.5f;
    attitude.quaternion.z = 0.5f;
    sample.has_accelerometer = false;
    sample.gyroscope.x = 4.0f;
    sample.gyroscope.y = 8.0f;
    sample.gyroscope.z = -12.0f;
    step();
    TEST_ASSERT_FLOAT_WITHIN(3e-5f, 0.5f - (0.5f * 0.000f), attitude.quaternion.w);
    TEST_ASSERT_FLOAT_WITHIN(3e-5f, 0.5f + (0.5f * (0.002f - 0.006f - 0.004f)),
                             attitude.quaternion.x);
    TEST_ASSERT_FLOAT_WITHIN(3e-5f, 0.5f + (0.5f * (0.004f + 0.006f + 0.002f)),
                             attitude.quaternion.y);
    TEST_ASSERT_FLOAT_WITHIN(3e-5f, 0.5f + (0.5f * (-0.006f + 0.004f - 0.002f)),
                             attitude.quaternion.z);
}

/* A scale that no configuration leads to shows the clamp: atan 2^-4 is turned, not more. */
static void ATT_009_turns_no_further_than_the_limit(void)
{
    attitude.scale.half_step = 1.0f;
    sample.gyroscope.x = 3.0f;
    step();
    TEST_ASSERT_FLOAT_WITHIN(2e-5f, sinf(atanf(0.0625f)), attitude.quaternion.x);
}

static void ATT_009_turns_no_further_about_any_axis(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        keel_attitude_vector_t part;

        setUp();
        attitude.scale.half_step = 1.0f;
        sample.has_accelerometer = false;
        *axis_of(&sample.gyroscope, axis_at(n)) = sign_at(n) * 3.0f;
        step();
        part.x = attitude.quaternion.x;
        part.y = attitude.quaternion.y;
        part.z = attitude.quaternion.z;
        TEST_ASSERT_FLOAT_WITHIN(2e-5f, sign_at(n) * sinf(atanf(0.0625f)),
                                 *axis_of(&part, axis_at(n)));
    }
}

/* Rolled by a sine of 0.1: the rate about x is too small. */
static void slightly_rolled(void)
{
    sample.accelerometer.y = -0.1f * G;
    sample.accelerometer.z = -0.9949874f * G;
}

static void ATT_012_bias_moves_against_the_error(void)
{
    run();
    slightly_rolled();
    step();
    vector_is(-0.0001f, 0.0f, 0.0f, attitude.bias);
    vector_is(0.0f, 0.0f, 0.0f, attitude.rate);
    step();
    vector_is(0.0001f, 0.0f, 0.0f, attitude.rate); /* The rate is W - B. */
}

static void ATT_012_bias_about_down_is_the_headings(void)
{
    run_with_heading();
    sample.magnetometer.x = 0.9949874f;
    sample.magnetometer.y = -0.1f;
    step();
    vector_is(0.0f, 0.0f, -0.0001f, attitude.bias);
}

static void ATT_012_a_heading_not_valid_moves_no_bias(void)
{
    run();
    sample.has_magnetometer = true;
    sample.magnetometer.x = 0.8f;
    sample.magnetometer.y = -0.6f;
    steps(10u);
    vector_is(0.0f, 0.0f, 0.0f, attitude.bias);
}

static void bias_rests(void)
{
    slightly_rolled();
    step();
    vector_is(0.0f, 0.0f, 0.0f, attitude.bias);
    setUp();
}

static void ATT_012_when_the_bias_rests(void)
{
    bias_rests(); /* Not still yet. */
    steps(4u);    /* Aligning. */
    bias_rests();
    run(); /* Turning. */
    sample.gyroscope.z = 0.51f;
    bias_rests();
    run(); /* A rate was lost. */
    sample.has_gyroscope = false;
    bias_rests();
    run(); /* No gravity. */
    sample.has_accelerometer = false;
    bias_rests();
    run(); /* A rate was lost, as tilt agrees again that did not before. */
    sample.accelerometer.y = -G;
    sample.accelerometer.z = 0.0f;
    step();
    TEST_ASSERT_EQUAL_UINT16(1u, attitude.settled);
    sample.has_gyroscope = false;
    bias_rests();
    run(); /* Measured and estimated down contradict: more than 60 degrees. */
    sample.accelerometer.y = -0.9f * G;
    sample.accelerometer.z = -0.45f * G;
    step();
    vector_is(0.0f, 0.0f, 0.0f, attitude.bias);
}

static void ATT_012_bias_stays_within_its_limit(void)
{
    config.tilt_gain = 0.0f;
    config.quiet_rate = 2.0f;
    make();
    run();
    for (uint32_t n = 0u; n < 6000u; n++) {
        slightly_rolled();
        sample.gyroscope = attitude.bias; /* So that nothing turns. */
        step();
        TEST_ASSERT_TRUE(attitude.bias.x >= -0.25f);
    }
    TEST_ASSERT_EQUAL_FLOAT(-0.25f, attitude.bias.x);
}

/* A scale that no configuration leads to: one step from limit to limit. The errors are a roll, a
 * pitch and a heading of sine 0.1, and the bias goes the other way. */
static void ATT_012_bias_stays_within_its_limit_about_any_axis(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        run_with_heading();
        attitude.scale.bias_step = 100.0f;
        if (axis_at(n) == 2u) {
            sample.magnetometer.x = 0.9949874f;
            sample.magnetometer.y = -sign_at(n) * 0.1f;
        } else {
            sample.accelerometer.x = (axis_at(n) == 1u) ? (sign_at(n) * 0.1f * G) : 0.0f;
            sample.accelerometer.y = (axis_at(n) == 0u) ? (-sign_at(n) * 0.1f * G) : 0.0f;
            sample.accelerometer.z = -0.9949874f * G;
        }
        step();
        TEST_ASSERT_EQUAL_FLOAT(-sign_at(n) * 0.25f, *axis_of(&attitude.bias, axis_at(n)));
    }
}

static void ATT_013_bias_is_the_mean_of_still_rates(void)
{
    const float x[] = {0.10f, 0.12f, 0.14f, 0.08f};

    for (uint32_t n = 0u; n < 4u; n++) {
        TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
        sample.gyroscope.x = x[n];
        sample.gyroscope.y = -0.05f;
        step();
    }
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    vector_is(0.11f, -0.05f, 0.0f, attitude.bias);
}

/* The still samples are counted from the moved one on, which is their first. */
static void moved_begins_anew(void)
{
    step();
    TEST_ASSERT_EQUAL_UINT16(1u, attitude.still);
    steps(2u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    setUp();
    steps(3u);
}

static void ATT_013_a_move_begins_anew(void)
{
    steps(3u);
    sample.gyroscope.x = 0.2501f; /* As a bias it is too much by default. */
    attitude.config.bias_limit = 0.5f;
    moved_begins_anew();
    sample.accelerometer.x = 0.501f;
    moved_begins_anew();
    sample.gyroscope.z = -0.24f;
    sample.accelerometer.x = -0.499f;
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
}

static void ATT_013_a_move_on_any_axis_begins_anew(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        steps(3u);
        *axis_of(&sample.gyroscope, axis_at(n)) = sign_at(n) * 0.2501f;
        step();
        TEST_ASSERT_EQUAL_UINT16(1u, attitude.still);
        setUp();
        steps(3u);
        *axis_of(&sample.accelerometer, axis_at(n)) += sign_at(n) * 0.501f;
        step();
        TEST_ASSERT_EQUAL_UINT16(1u, attitude.still);
    }
}

static void bad_begins_anew(void)
{
    step();
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.still);
    sample = rest;
    steps(3u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
}

static void ATT_013_a_sample_that_misses_begins_anew(void)
{
    steps(3u);
    sample.has_gyroscope = false;
    bad_begins_anew();
    sample.gyroscope.x = 33.0f;
    bad_begins_anew();
    sample.has_accelerometer = false;
    bad_begins_anew();
    sample.accelerometer.z = NAN;
    bad_begins_anew();
}

static void ATT_013_a_force_that_cannot_be_on_any_axis_begins_anew(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        steps(3u);
        *axis_of(&sample.accelerometer, axis_at(n)) = sign_at(n) * 320.5f;
        bad_begins_anew();
    }
}

static void ATT_013_a_bias_beyond_its_limit_about_any_axis(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        *axis_of(&sample.gyroscope, axis_at(n)) = sign_at(n) * 0.2501f;
        steps(4u);
        TEST_ASSERT_EQUAL_HEX32(KEEL_ATTITUDE_BIASED, attitude.flags & KEEL_ATTITUDE_BIASED);
        *axis_of(&sample.gyroscope, axis_at(n)) = sign_at(n) * 0.2499f;
        steps(4u);
        TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    }
}

static void ATT_013_a_bias_beyond_its_limit_is_told(void)
{
    sample.gyroscope.z = 0.26f;
    steps(3u);
    TEST_ASSERT_EQUAL_HEX32(0u, attitude.flags & KEEL_ATTITUDE_BIASED);
    step();
    TEST_ASSERT_EQUAL_HEX32(KEEL_ATTITUDE_BIASED, attitude.flags & KEEL_ATTITUDE_BIASED);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.still);
    vector_is(0.0f, 0.0f, 0.0f, attitude.bias);
}

static void ATT_014_valid_after_agreeing_in_a_row(void)
{
    steps(5u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    sample.accelerometer.y = -0.2f * G; /* Beyond the tolerance of 0.125. */
    step();
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.settled);
    sample = rest;
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    sample.has_accelerometer = false; /* Says nothing. */
    steps(10u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    sample = rest;
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
}

static void ATT_014_not_valid_upside_down_or_after_a_lost_rate(void)
{
    steps(4u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    sample.accelerometer.z = G; /* The sine of its error is 0. */
    steps(10u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    setUp();
    steps(4u);
    sample.has_gyroscope = false;
    steps(2u);
    sample.has_gyroscope = true;
    step();
    TEST_ASSERT_EQUAL_UINT16(1u, attitude.lost);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.settled);
    steps(2u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
}

/* With down at 90 degrees from the estimated one, two samples more than those that agree. */
static void ATT_014_contradiction_ends_it(void)
{
    config.tilt_gain = 0.0f;
    make();
    run_with_heading();
    sample.accelerometer.y = -G;
    sample.accelerometer.z = 0.0f;
    step();
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    sample.accelerometer = rest.accelerometer;
    steps(5u);
    TEST_ASSERT_EQUAL_UINT16(2u, attitude.settled);
    sample.accelerometer.y = -G;
    sample.accelerometer.z = 0.0f;
    steps(2u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    TEST_ASSERT_FALSE(attitude.heading_valid);
}

static void ATT_014_sixty_degrees_are_no_contradiction(void)
{
    config.tilt_gain = 0.0f;
    make();
    run();
    sample.accelerometer.y = -0.86f * G; /* 59 degrees. */
    sample.accelerometer.z = -0.51f * G;
    steps(50u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
}

static void ATT_015_heading_is_valid_after_tilt(void)
{
    sample.has_magnetometer = true;
    steps(6u);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.heading_settled);
    step();
    TEST_ASSERT_FALSE(attitude.heading_valid);
    sample.magnetometer.y = 0.2f; /* Beyond the tolerance. */
    step();
    sample.magnetometer.y = 0.0f;
    step();
    TEST_ASSERT_FALSE(attitude.heading_valid);
    step();
    TEST_ASSERT_TRUE(attitude.heading_valid);
}

static void ATT_015_a_field_behind_ends_it(void)
{
    config.heading_gain = 0.0f;
    make();
    run_with_heading();
    sample.magnetometer.x = -1.0f;
    step();
    TEST_ASSERT_TRUE(attitude.heading_valid);
    sample.magnetometer.x = 1.0f;
    steps(5u);
    sample.magnetometer.x = -1.0f;
    steps(2u);
    TEST_ASSERT_FALSE(attitude.heading_valid);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
    sample.magnetometer.y = 0.01f; /* Near in sine, but behind. */
    steps(5u);
    TEST_ASSERT_FALSE(attitude.heading_valid);
}

static void ATT_015_a_field_that_stays_away_ends_it(void)
{
    run_with_heading();
    sample.has_magnetometer = false;
    steps(4u);
    TEST_ASSERT_TRUE(attitude.heading_valid);
    step();
    TEST_ASSERT_FALSE(attitude.heading_valid);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.heading_settled);
}

static void corrupted(float w, float x)
{
    attitude.quaternion.w = w;
    attitude.quaternion.x = x;
    attitude.down.y = 1.0f;
    attitude.field.y = 1.0f;
    sample.has_accelerometer = false;
    step();
    vector_is(0.0f, 0.0f, 0.0f, attitude.down);
    vector_is(0.0f, 0.0f, 0.0f, attitude.field);
    TEST_ASSERT_EQUAL_HEX32(KEEL_ATTITUDE_CORRUPTED, attitude.flags & KEEL_ATTITUDE_CORRUPTED);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, attitude.quaternion.w);
    turned_by(0.0f, 0.0f, 0.0f);
}

static void ATT_016_a_quaternion_that_is_none_is_replaced(void)
{
    run_with_heading();
    corrupted(0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_ALIGNING, attitude.phase);
    TEST_ASSERT_FALSE(attitude.heading_valid);
    corrupted(NAN, 0.0f);
    corrupted(1.0f, INFINITY);
    corrupted(1.0f, 0.5f);
    corrupted(0.5f, 0.0f);
    keel_attitude_restart(&attitude);
    corrupted(0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_STILL, attitude.phase);
}

/* |q|^2 within 1 +- 2^-12; beyond it, a little or much; and no number. */
static void ATT_016_a_unit_quaternion_is_one_of_length_1(void)
{
    const keel_attitude_quaternion_t units[] = {{1.0f, 0.0f, 0.0f, 0.0f},
                                                {-0.5f, 0.5f, -0.5f, 0.5f},
                                                {0.0f, 0.0f, 1.00006f, 0.0f},
                                                {0.0f, 0.6f, 0.0f, -0.8f}};
    const keel_attitude_quaternion_t others[] = {
        {0.0f, 0.0f, 0.0f, 0.0f},     {1.0f, 1.0f, 0.0f, 0.0f},    {0.0f, 1.00013f, 0.0f, 0.0f},
        {0.0f, 0.0f, 0.0f, 0.99987f}, {NAN, 0.0f, 0.0f, 0.0f},     {1.0f, 0.0f, NAN, 0.0f},
        {0.0f, INFINITY, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, -1.0e30f}};

    for (size_t i = 0u; i < (sizeof units / sizeof units[0]); i++) {
        TEST_ASSERT_TRUE(keel_attitude_is_unit(units[i]));
    }
    for (size_t i = 0u; i < (sizeof others / sizeof others[0]); i++) {
        TEST_ASSERT_FALSE(keel_attitude_is_unit(others[i]));
    }
}

static void ATT_019_down_as_the_body_sees_it(void)
{
    vector_is(0.0f, 0.0f, 1.0f, keel_attitude_down(&attitude));
    attitude.quaternion.w = 0.9486833f; /* A roll of sine 0.6. */
    attitude.quaternion.x = 0.3162278f;
    vector_is(0.0f, 0.6f, 0.8f, keel_attitude_down(&attitude));
    attitude.quaternion.x = 0.0f;
    attitude.quaternion.y = 0.3162278f; /* Nose up. */
    vector_is(-0.6f, 0.0f, 0.8f, keel_attitude_down(&attitude));
}

/* As configured: 1000 steps a second. */
static void as_configured(void)
{
    attitude.scale.step = 0.001f;
}

/* A field that is behind while no force comes: heading is not judged right by it, and tilt stays
 * what it was. */
static void ATT_017_a_field_that_is_behind_without_a_force(void)
{
    run();
    sample.has_magnetometer = true;
    sample.magnetometer = (keel_attitude_vector_t){-1.0f, 0.0f, 2.0f};
    sample.has_accelerometer = false;
    step();
    flags_are(KEEL_ATTITUDE_FIELD);
    TEST_ASSERT_FALSE(attitude.heading_valid);
    TEST_ASSERT_EQUAL_UINT16(0u, attitude.heading_settled);
    TEST_ASSERT_EQUAL(KEEL_ATTITUDE_RUNNING, attitude.phase);
}

/* One step that is off by 0.4 about x and y and by 0.5 in heading, all one way: bias_gain of 1 in
 * 1 ms, of no more than the tolerance, 0.125. */
static void follows(float way, float before, float after)
{
    setUp();
    run();
    attitude.bias = (keel_attitude_vector_t){before, before, before};
    sample.gyroscope = attitude.bias;
    sample.accelerometer = (keel_attitude_vector_t){way * 0.4f * G, way * -0.4f * G, -0.8f * G};
    attitude.heading_valid = true;
    attitude.heading_error = way * 0.5f;
    attitude.field_age = 0u;
    step();
    vector_is(after, after, after, attitude.bias);
}

static void ATT_012_the_bias_follows_no_more_than_the_tolerance(void)
{
    follows(1.0f, 0.0f, -0.000125f);
    follows(-1.0f, 0.0f, 0.000125f);
    follows(1.0f, 0.1f, 0.099875f);
}

static void ATT_012_the_bias_stays_within_its_limit(void)
{
    follows(1.0f, -0.25f, -0.25f);
    follows(-1.0f, 0.25f, 0.25f);
}

static void ATT_020_what_is_kept_stays_within_reach(void)
{
    const float most = KEEL_ATTITUDE_FIELD_REACH;

    run();
    attitude.field = (keel_attitude_vector_t){2.0f * most, 2.0f * most, 2.0f * most};
    step();
    vector_is(most, most, most, attitude.field);
    attitude.field = (keel_attitude_vector_t){-2.0f * most, -2.0f * most, -2.0f * most};
    step();
    vector_is(-most, -most, -most, attitude.field);
}

/* Nose east: 3 m/s^2 to the east are 3 forward to the body, in the Earth's frame (0, -3, g) / g;
 * 8/s in 1 ms are a share of 0.008. */
static void ATT_020_force_is_low_passed_in_the_earths_frame(void)
{
    as_configured();
    attitude.quaternion.w = 0.70710678f;
    attitude.quaternion.z = 0.70710678f;
    sample.accelerometer.x = 3.0f;
    step();
    flags_are(0u); /* Not enough of it to be gravity. */
    vector_is(0.0f, -0.00244732f, 0.008f, attitude.down);
    step();
    vector_is(0.0f, -0.00487506f, 0.015936f, attitude.down);
}

/* 0.5/s in 1 ms, while running. A single sample, whatever it is, neither closes the gate nor counts
 * against the tilt; it turns by next to nothing: 0.0005 x 3 down's, 0.5/s of it in 1 ms, halved. */
static void ATT_020_a_single_force_says_little(void)
{
    config.force_gain = 0.5f;
    make();
    run();
    as_configured();
    attitude.down = (keel_attitude_vector_t){0.0f, 0.0f, 1.0f};
    sample.accelerometer.y = -3.0f * G;
    sample.accelerometer.z = 3.0f * G;
    step();
    flags_are(KEEL_ATTITUDE_DOWN);
    TEST_ASSERT_EQUAL_UINT16(2u, attitude.settled);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0015f, attitude.down.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.998f, attitude.down.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-9f, 0.000000375f, attitude.quaternion.x);
}

/* (0.6, 0, 0.8) is corrected by 0.5/s x 0.6 about -y: 0.0003 in 1 ms, a turn of which adds
 * (-0.8, 0, 0.6) x 0.0003; and to the field north and down (-1, 0, 1) x 0.0003. */
static void ATT_020_what_is_low_passed_turns_along(void)
{
    run();
    as_configured();
    attitude.config.force_gain = 0.0f;
    attitude.down = (keel_attitude_vector_t){0.6f, 0.0f, 0.8f};
    attitude.field = (keel_attitude_vector_t){1.0f, 0.0f, 1.0f};
    step();
    vector_is(0.59976f, 0.0f, 0.80018f, attitude.down);
    vector_is(0.9997f, 0.0f, 1.0003f, attitude.field);
    turned_by(0.0f, -0.00015f, 0.0f);
}

/* A heading's error of 0.6, corrected by 0.25/s: 0.00015 in 1 ms, about down. */
static void ATT_020_the_field_turns_along_with_the_heading(void)
{
    run_with_heading();
    as_configured();
    attitude.config.field_share = 0.0f;
    attitude.down = (keel_attitude_vector_t){0.0f, 0.0f, 1.0f};
    attitude.field = (keel_attitude_vector_t){0.8f, -0.6f, 2.0f};
    step();
    TEST_ASSERT_EQUAL_FLOAT(0.6f, attitude.heading_error);
    vector_is(0.8f + (0.6f * 0.00015f), -0.6f + (0.8f * 0.00015f), 2.0f, attitude.field);
    turned_by(0.0f, 0.0f, 0.000075f);
}

/* Rolled right by half a turn: (1, 0, -2) to the body is (1, 0, 2) to the Earth. */
static void ATT_020_field_is_low_passed_in_the_earths_frame(void)
{
    config.field_share = 0.25f;
    make();
    as_configured();
    attitude.quaternion.w = 0.0f;
    attitude.quaternion.x = 1.0f;
    sample.has_magnetometer = true;
    sample.magnetometer.z = -2.0f;
    step();
    vector_is(0.25f, 0.0f, 0.5f, attitude.field);
    flags_are(0u); /* Not enough of it. */
    step();
    vector_is(0.4375f, 0.0f, 0.875f, attitude.field);
    steps(2u); /* 1 - 0.75^4 = 0.684, whose square is below 0.5. */
    flags_are(0u);
    step(); /* 0.763 */
    flags_are(KEEL_ATTITUDE_FIELD);
}

static void ATT_020_a_field_beyond_its_reach_is_none(void)
{
    for (uint32_t n = 0u; n < WAYS; n++) {
        setUp();
        run_with_heading();
        *axis_of(&sample.magnetometer, axis_at(n)) = sign_at(n) * 4097.0f;
        step();
        flags_are(KEEL_ATTITUDE_DOWN);
        vector_is(1.0f, 0.0f, 2.0f, attitude.field);
    }
}

/* What was low-passed five steps ago is of another attitude. */
static void ATT_020_an_old_field_is_forgotten(void)
{
    run_with_heading();
    sample.has_magnetometer = false;
    steps(4u);
    vector_is(1.0f, 0.0f, 2.0f, attitude.field);
    step();
    vector_is(0.0f, 0.0f, 0.0f, attitude.field);
}

/* The bias follows no more of an error than the tolerance, 0.125: 0.001/s x 0.125. */
static void ATT_012_a_large_error_moves_the_bias_no_more(void)
{
    run();
    rolled();
    step();
    vector_is(-0.000125f, 0.0f, 0.0f, attitude.bias);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ATT_001_bad_rates_are_refused);
    RUN_TEST(ATT_001_bad_gains_are_refused);
    RUN_TEST(ATT_001_bad_limits_are_refused);
    RUN_TEST(ATT_001_no_steps_are_refused);
    RUN_TEST(ATT_001_bad_fields_are_refused);
    RUN_TEST(ATT_001_first_fault_is_told);
    RUN_TEST(ATT_002_what_follows_from_a_configuration);
    RUN_TEST(ATT_003_begins_level_and_not_valid);
    RUN_TEST(ATT_003_a_restart_forgets);
    RUN_TEST(ATT_004_takes_what_the_vote_gave);
    RUN_TEST(ATT_004_a_held_output_is_no_sample);
    RUN_TEST(ATT_005_a_lost_rate_is_held_for_a_while);
    RUN_TEST(ATT_005_one_good_rate_makes_up_for_one_lost);
    RUN_TEST(ATT_005_rates_that_cannot_be_are_lost);
    RUN_TEST(ATT_005_clipped_rates_are_used_and_told);
    RUN_TEST(ATT_005_a_clipped_rate_about_any_axis);
    RUN_TEST(ATT_006_rolls_towards_down);
    RUN_TEST(ATT_006_pitches_towards_down);
    RUN_TEST(ATT_006_upside_down_is_no_rest);
    RUN_TEST(ATT_006_only_about_1_g_is_gravity);
    RUN_TEST(ATT_006_gravity_is_measured_in_fast_turns);
    RUN_TEST(ATT_006_a_force_beyond_the_limit_on_any_axis);
    RUN_TEST(ATT_006_upside_down_is_no_rest_later);
    RUN_TEST(ATT_007_acceleration_is_taken_off);
    RUN_TEST(ATT_007_acceleration_is_the_earths);
    RUN_TEST(ATT_007_acceleration_that_cannot_be_is_ignored);
    RUN_TEST(ATT_007_acceleration_beyond_the_limit_on_any_axis);
    RUN_TEST(ATT_008_turns_to_the_heading);
    RUN_TEST(ATT_008_declination);
    RUN_TEST(ATT_008_beyond_a_right_angle_the_error_is_full);
    RUN_TEST(ATT_008_other_fields_are_ignored);
    RUN_TEST(ATT_008_an_error_is_kept_for_five_steps);
    RUN_TEST(ATT_009_turns_as_the_product_says);
    RUN_TEST(ATT_009_turns_no_further_than_the_limit);
    RUN_TEST(ATT_009_turns_no_further_about_any_axis);
    RUN_TEST(ATT_012_bias_moves_against_the_error);
    RUN_TEST(ATT_012_bias_about_down_is_the_headings);
    RUN_TEST(ATT_012_a_heading_not_valid_moves_no_bias);
    RUN_TEST(ATT_012_a_large_error_moves_the_bias_no_more);
    RUN_TEST(ATT_012_when_the_bias_rests);
    RUN_TEST(ATT_012_bias_stays_within_its_limit);
    RUN_TEST(ATT_012_bias_stays_within_its_limit_about_any_axis);
    RUN_TEST(ATT_013_bias_is_the_mean_of_still_rates);
    RUN_TEST(ATT_013_a_move_begins_anew);
    RUN_TEST(ATT_013_a_move_on_any_axis_begins_anew);
    RUN_TEST(ATT_013_a_sample_that_misses_begins_anew);
    RUN_TEST(ATT_013_a_force_that_cannot_be_on_any_axis_begins_anew);
    RUN_TEST(ATT_013_a_bias_beyond_its_limit_about_any_axis);
    RUN_TEST(ATT_013_a_bias_beyond_its_limit_is_told);
    RUN_TEST(ATT_014_valid_after_agreeing_in_a_row);
    RUN_TEST(ATT_014_not_valid_upside_down_or_after_a_lost_rate);
    RUN_TEST(ATT_014_contradiction_ends_it);
    RUN_TEST(ATT_014_sixty_degrees_are_no_contradiction);
    RUN_TEST(ATT_015_heading_is_valid_after_tilt);
    RUN_TEST(ATT_015_a_field_behind_ends_it);
    RUN_TEST(ATT_015_a_field_that_stays_away_ends_it);
    RUN_TEST(ATT_016_a_quaternion_that_is_none_is_replaced);
    RUN_TEST(ATT_016_a_unit_quaternion_is_one_of_length_1);
    RUN_TEST(ATT_019_down_as_the_body_sees_it);
    RUN_TEST(ATT_017_a_field_that_is_behind_without_a_force);
    RUN_TEST(ATT_012_the_bias_follows_no_more_than_the_tolerance);
    RUN_TEST(ATT_012_the_bias_stays_within_its_limit);
    RUN_TEST(ATT_020_what_is_kept_stays_within_reach);
    RUN_TEST(ATT_020_force_is_low_passed_in_the_earths_frame);
    RUN_TEST(ATT_020_a_single_force_says_little);
    RUN_TEST(ATT_020_what_is_low_passed_turns_along);
    RUN_TEST(ATT_020_the_field_turns_along_with_the_heading);
    RUN_TEST(ATT_020_field_is_low_passed_in_the_earths_frame);
    RUN_TEST(ATT_020_a_field_beyond_its_reach_is_none);
    RUN_TEST(ATT_020_an_old_field_is_forgotten);
    return UNITY_END();
}
