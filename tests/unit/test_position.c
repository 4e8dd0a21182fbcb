/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/position.h. Metres are those of the ellipsoid of WGS 84, in double
 * precision, by its radii of curvature. */
#include "keel/flight/position.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define DEGREES 10000000

static const double PI = 3.14159265358979323846;

static keel_position_config_t config;
static keel_position_t position;
static keel_position_sample_t sample;

void setUp(void)
{
    const keel_position_config_t usual = {.axis = {.rate_hz = 50.0f,
                                                   .position_gain = 1.0f,
                                                   .velocity_gain = 0.0f,
                                                   .rate_gain = 0.5f,
                                                   .bias_gain = 0.0f,
                                                   .position_gate = 16384.0f,
                                                   .velocity_gate = 256.0f,
                                                   .late_steps = 10u,
                                                   .lost_steps = 100u,
                                                   .settle_fixes = 1u,
                                                   .jump_fixes = 3u},
                                          .accuracy = 5.0f,
                                          .speed_accuracy = 1.0f};
    const keel_position_sample_t still = {
        .fix = {.accuracy = 2.0f, .speed_accuracy = 0.5f, .is_valid = true},
        .has_acceleration = true};

    config = usual;
    sample = still;
    memset(&position, 0x55, sizeof position);
}

void tearDown(void)
{
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_position_init(&position, &config));
}

static void make_at(int32_t latitude, int32_t longitude)
{
    make();
    TEST_ASSERT_EQUAL(KEEL_OK, keel_position_set_origin(&position, latitude, longitude));
}

static void measure(int32_t latitude, int32_t longitude)
{
    sample.fix.latitude = latitude;
    sample.fix.longitude = longitude;
    sample.has_fix = true;
    keel_position_step(&position, &sample);
    sample.has_fix = false;
}

static void init_refuses(keel_status_t status)
{
    keel_position_t before;

    memcpy(&before, &position, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_position_init(&position, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &position, sizeof position);
}

static void has_range(float *value, float most)
{
    const float good = *value;
    const float bad[] = {-1.0e-6f, nextafterf(most, INFINITY), NAN, INFINITY};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *value = bad[i];
        init_refuses(KEEL_ERR_LIMITS);
    }
    *value = 0.0f;
    make();
    *value = most;
    make();
    *value = good;
    memset(&position, 0x55, sizeof position);
}

static void POS_001_bad_accuracies_are_refused(void)
{
    has_range(&config.accuracy, 100.0f);
    has_range(&config.speed_accuracy, 10.0f);
}

static void POS_001_refusals_of_the_axis_come_second(void)
{
    config.axis.jump_fixes = 0u;
    init_refuses(KEEL_ERR_LIMITS);
    config.axis.bias_gain = NAN;
    init_refuses(KEEL_ERR_GAIN);
    config.axis.rate_hz = 1.0f;
    init_refuses(KEEL_ERR_RATE);
    config.accuracy = NAN;
    init_refuses(KEEL_ERR_LIMITS);
}

static void POS_002_made_with_nothing_known(void)
{
    make();
    TEST_ASSERT_EQUAL_MEMORY(&config, &position.config, sizeof config);
    TEST_ASSERT_FALSE(position.has_origin);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, position.quality);
    TEST_ASSERT_EQUAL_MEMORY(&config.axis, &position.north.config, sizeof config.axis);
    TEST_ASSERT_EQUAL_MEMORY(&config.axis, &position.east.config, sizeof config.axis);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, position.north.quality);
    TEST_ASSERT_EQUAL_INT32(0, position.latitude);
    TEST_ASSERT_EQUAL_INT32(0, position.longitude);
}

static void origin_is_refused(int32_t latitude, int32_t longitude)
{
    keel_position_t before;

    make_at(5, 6);
    before = position;
    TEST_ASSERT_EQUAL(KEEL_ERR_VALUE, keel_position_set_origin(&position, latitude, longitude));
    TEST_ASSERT_EQUAL_MEMORY(&before, &position, sizeof position);
}

static void POS_003_origins_out_of_range_are_refused(void)
{
    origin_is_refused((80 * DEGREES) + 1, 0);
    origin_is_refused((-80 * DEGREES) - 1, 0);
    origin_is_refused(0, (180 * DEGREES) + 1);
    origin_is_refused(0, (-180 * DEGREES) - 1);
    origin_is_refused(INT32_MIN, 0);
    origin_is_refused(0, INT32_MAX);
    make_at(80 * DEGREES, 180 * DEGREES);
    make_at(-80 * DEGREES, -180 * DEGREES);
}

static void POS_003_a_new_origin_forgets(void)
{
    make_at(0, 0);
    measure(1000, 1000);
    measure(1000, 1000);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, position.quality);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_position_set_origin(&position, 7, 8));
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, position.quality);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, position.north.quality);
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, position.east.quality);
    TEST_ASSERT_EQUAL_INT32(7, position.latitude);
    TEST_ASSERT_EQUAL_INT32(8, position.longitude);
    TEST_ASSERT_TRUE(position.has_origin);
}

/* Metres per 1e-7 degrees: the meridian's radius of curvature, and that of the parallel. */
static void scales_at(double degrees, double *north, double *east)
{
    const double a = 6378137.0;
    const double e2 = 6.69437999014e-3;
    const double f = degrees * PI / 180.0;
    const double w = 1.0 - (e2 * sin(f) * sin(f));

    *north = a * (1.0 - e2) / (w * sqrt(w)) * PI / 180.0 * 1.0e-7;
    *east = a / sqrt(w) * cos(f) * PI / 180.0 * 1.0e-7;
}

static void POS_004_scales_are_the_ellipsoids(void)
{
    for (int32_t degrees = -80; degrees <= 80; degrees++) {
        double north;
        double east;

        make_at(degrees * DEGREES, 0);
        scales_at(degrees, &north, &east);
        TEST_ASSERT_TRUE(fabs((double)position.north_scale - north) <= (2e-5 * north));
        TEST_ASSERT_TRUE(fabs((double)position.east_scale - east) <= (2e-5 * east));
    }
}

static void is_unusable(void)
{
    measure(500, 500);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.north.flags);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.east.flags);
    TEST_ASSERT_NOT_EQUAL(KEEL_AXIS_GOOD, position.quality);
}

static void settle(void)
{
    make_at(0, 0);
    measure(0, 0);
    measure(0, 0);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, position.quality);
}

static void POS_005_without_an_origin_no_fix_can_be_used(void)
{
    make();
    is_unusable();
}

static void POS_005_what_the_receiver_does_not_trust_is_not_used(void)
{
    const float bad[] = {nextafterf(5.0f, INFINITY), NAN, INFINITY, -1.0f};

    settle();
    sample.fix.is_valid = false;
    is_unusable();
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        setUp();
        settle();
        sample.fix.accuracy = bad[i];
        is_unusable();
    }
    setUp();
    settle();
    sample.fix.accuracy = 5.0f;
    measure(500, 500);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, position.north.flags);
}

/* 2^24 of 1e-7 degrees, some 187 km. */
static void POS_005_what_is_far_away_is_not_used(void)
{
    const int32_t far = 16777217;
    const int32_t ways[4][2] = {{far, 0}, {-far, 0}, {0, far}, {0, -far}};

    for (size_t i = 0u; i < 4u; i++) {
        settle();
        measure(ways[i][0], ways[i][1]);
        TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.north.flags);
        TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.east.flags);
    }
    settle();
    measure(INT32_MIN, INT32_MAX);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.north.flags);
}

/* Near, but further than an axis goes: in its direction alone. */
static void POS_005_beyond_an_axis_limit_that_axis_tells(void)
{
    settle();
    measure(16777216, 100);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.north.flags);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, position.east.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, position.quality);
    settle();
    measure(100, -16777216);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, position.north.flags);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, position.east.flags);
}

/* Halfway between what was predicted, at rest, and what is measured: the rate's gain is 0.5. */
static void POS_005_velocities_count_when_accurate(void)
{
    settle();
    sample.fix.north = 2.0f;
    sample.fix.east = -4.0f;
    measure(0, 0);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, position.north.velocity);
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, position.east.velocity);
    setUp();
    settle();
    sample.fix.north = 2.0f;
    sample.fix.speed_accuracy = 1.001f;
    measure(0, 0);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, position.north.velocity);
    sample.fix.speed_accuracy = -1.0f;
    measure(0, 0);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, position.north.velocity);
}

/* 1000 of 1e-7 degrees at 48 degrees north. */
static void POS_006_degrees_become_metres(void)
{
    double north;
    double east;

    scales_at(48.0, &north, &east);
    make_at(48 * DEGREES, 11 * DEGREES);
    measure((48 * DEGREES) + 1000, (11 * DEGREES) - 2000);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)(1000.0 * north), position.north.position);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)(-2000.0 * east), position.east.position);
}

static void POS_006_the_180th_meridian_is_crossed(void)
{
    make_at(0, (180 * DEGREES) - 1000);
    measure(0, (-180 * DEGREES) + 1000);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 2000.0f * 0.0111319f, position.east.position);
    make_at(0, (-180 * DEGREES) + 1000);
    measure(0, (180 * DEGREES) - 1000);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, -2000.0f * 0.0111319f, position.east.position);
}

static void POS_007_accelerations_carry_it_on(void)
{
    settle();
    sample.north = 1.0f;
    sample.east = -2.0f;
    for (unsigned i = 0u; i < 50u; i++) {
        keel_position_step(&position, &sample);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 1.0f, position.north.velocity);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, -2.0f, position.east.velocity);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.5f, position.north.position);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, -1.0f, position.east.position);
    sample.has_acceleration = false;
    keel_position_step(&position, &sample);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_BLIND, position.north.flags);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_BLIND, position.east.flags);
}

static void POS_009_the_quality_is_that_of_the_worse(void)
{
    config.axis.position_gate = 10.0f;
    settle();
    measure(2000, 0);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, position.north.quality);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, position.east.quality);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, position.quality);
    settle();
    measure(0, 2000);
    TEST_ASSERT_EQUAL(KEEL_AXIS_GOOD, position.north.quality);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, position.quality);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(POS_001_bad_accuracies_are_refused);
    RUN_TEST(POS_001_refusals_of_the_axis_come_second);
    RUN_TEST(POS_002_made_with_nothing_known);
    RUN_TEST(POS_003_origins_out_of_range_are_refused);
    RUN_TEST(POS_003_a_new_origin_forgets);
    RUN_TEST(POS_004_scales_are_the_ellipsoids);
    RUN_TEST(POS_005_without_an_origin_no_fix_can_be_used);
    RUN_TEST(POS_005_what_the_receiver_does_not_trust_is_not_used);
    RUN_TEST(POS_005_what_is_far_away_is_not_used);
    RUN_TEST(POS_005_beyond_an_axis_limit_that_axis_tells);
    RUN_TEST(POS_005_velocities_count_when_accurate);
    RUN_TEST(POS_006_degrees_become_metres);
    RUN_TEST(POS_006_the_180th_meridian_is_crossed);
    RUN_TEST(POS_007_accelerations_carry_it_on);
    RUN_TEST(POS_009_the_quality_is_that_of_the_worse);
    return UNITY_END();
}
