/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/altitude.h. Heights are those of the International Standard Atmosphere
 * (ISO 2533), in double precision, with the powers that the code does without. */
#include "keel/flight/altitude.h"
#include "unity.h"

#include <math.h>
#include <string.h>

static keel_axis_config_t config;
static keel_altitude_t altitude;
static keel_altitude_sample_t sample;

void setUp(void)
{
    const keel_axis_config_t usual = {.rate_hz = 50.0f,
                                      .position_gain = 1.0f,
                                      .velocity_gain = 0.0f,
                                      .bias_gain = 0.0f,
                                      .position_gate = 16384.0f,
                                      .late_steps = 10u,
                                      .lost_steps = 100u,
                                      .settle_fixes = 1u,
                                      .jump_fixes = 3u};
    const keel_altitude_sample_t still = {.has_acceleration = true};

    config = usual;
    sample = still;
    memset(&altitude, 0x55, sizeof altitude);
}

void tearDown(void)
{
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_altitude_init(&altitude, &config));
}

static void measure(float pressure)
{
    sample.has_pressure = true;
    sample.pressure = pressure;
    keel_altitude_step(&altitude, &sample);
    sample.has_pressure = false;
}

/* ISO 2533, formula (12): pressure at a height above sea level, below 11 km. */
static double standard_pressure(double height)
{
    return 101325.0 * pow(1.0 - (0.0065 * height / 288.15), 9.80665 / (0.0065 * 287.05287));
}

/* How far off the height is of what is measured so high above sea level. */
static double error_at(double height)
{
    make();
    measure((float)standard_pressure(0.0));
    measure((float)standard_pressure(height));
    return fabs((double)altitude.height - height);
}

static void ALT_001_refusals_are_those_of_the_axis(void)
{
    keel_altitude_t before;

    memcpy(&before, &altitude, sizeof before);
    config.jump_fixes = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_altitude_init(&altitude, &config));
    config.bias_gain = -1.0f;
    TEST_ASSERT_EQUAL(KEEL_ERR_GAIN, keel_altitude_init(&altitude, &config));
    config.rate_hz = 0.0f;
    TEST_ASSERT_EQUAL(KEEL_ERR_RATE, keel_altitude_init(&altitude, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &altitude, sizeof altitude);
}

static void ALT_002_made_with_nothing_known(void)
{
    make();
    TEST_ASSERT_EQUAL(KEEL_AXIS_NONE, altitude.axis.quality);
    TEST_ASSERT_FALSE(altitude.has_reference);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.reference);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.zero);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.height);
}

static void ALT_003_where_it_is_becomes_0(void)
{
    make();
    measure(100000.0f);
    measure((float)(100000.0 * exp(-100.0 / 8434.5)));
    TEST_ASSERT_FLOAT_WITHIN(0.2f, 100.0f, altitude.height);
    keel_altitude_zero(&altitude);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.height);
    keel_altitude_step(&altitude, &sample);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.height);
    measure(100000.0f);
    TEST_ASSERT_FLOAT_WITHIN(0.2f, -100.0f, altitude.height);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.axis.position);
}

static void ALT_004_the_first_pressure_is_the_reference(void)
{
    make();
    measure(NAN);
    TEST_ASSERT_FALSE(altitude.has_reference);
    measure(95000.0f);
    TEST_ASSERT_TRUE(altitude.has_reference);
    TEST_ASSERT_EQUAL_FLOAT(95000.0f, altitude.reference);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.height);
    measure(94000.0f);
    TEST_ASSERT_EQUAL_FLOAT(95000.0f, altitude.reference);
}

static void ALT_004_nothing_measured_is_no_reference(void)
{
    make();
    sample.pressure = 95000.0f;
    keel_altitude_step(&altitude, &sample);
    TEST_ASSERT_FALSE(altitude.has_reference);
    TEST_ASSERT_EQUAL_HEX32(0u, altitude.axis.flags);
}

static void ALT_005_pressures_out_of_range_do_not_count(void)
{
    const float bad[] = {NAN,
                         INFINITY,
                         -INFINITY,
                         0.0f,
                         nextafterf(30000.0f, 0.0f),
                         nextafterf(120000.0f, INFINITY)};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        make();
        measure(100000.0f);
        measure(99000.0f);
        measure(bad[i]);
        TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_UNUSABLE, altitude.axis.flags);
        TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, altitude.axis.quality);
        TEST_ASSERT_FLOAT_WITHIN(1.0f, 84.8f, altitude.height);
    }
}

/* At the ends of the range all is a fix that counts. */
static void ALT_005_pressures_in_range_count(void)
{
    make();
    measure(30000.0f);
    measure(120000.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, altitude.axis.flags);
    make();
    measure(120000.0f);
    measure(30000.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_FIXED, altitude.axis.flags);
}

/* A spike of 10 hPa, some 85 m, beyond a gate of 10 m. */
static void ALT_005_a_spike_is_a_jump(void)
{
    config.position_gate = 10.0f;
    make();
    measure(100000.0f);
    measure(100000.0f);
    measure(101000.0f);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_JUMPED, altitude.axis.flags);
    TEST_ASSERT_EQUAL(KEEL_AXIS_POOR, altitude.axis.quality);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, altitude.height);
}

static void ALT_006_acceleration_carries_it_on(void)
{
    make();
    measure(100000.0f);
    sample.acceleration = 2.0f;
    for (unsigned i = 0u; i < 50u; i++) {
        keel_altitude_step(&altitude, &sample);
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 2.0f, altitude.axis.velocity);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 1.0f, altitude.height);
    sample.has_acceleration = false;
    keel_altitude_step(&altitude, &sample);
    TEST_ASSERT_EQUAL_HEX32(KEEL_AXIS_BLIND, altitude.axis.flags);
}

static void ALT_007_heights_are_the_standard_atmospheres(void)
{
    for (double height = -500.0; height <= 500.0; height += 12.5) {
        TEST_ASSERT_TRUE(error_at(height) <= 0.03);
    }
    TEST_ASSERT_TRUE(error_at(1000.0) <= 0.1);
    TEST_ASSERT_TRUE(error_at(-1000.0) <= 0.1);
    TEST_ASSERT_TRUE(error_at(2000.0) <= 1.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(ALT_001_refusals_are_those_of_the_axis);
    RUN_TEST(ALT_002_made_with_nothing_known);
    RUN_TEST(ALT_003_where_it_is_becomes_0);
    RUN_TEST(ALT_004_the_first_pressure_is_the_reference);
    RUN_TEST(ALT_004_nothing_measured_is_no_reference);
    RUN_TEST(ALT_005_pressures_out_of_range_do_not_count);
    RUN_TEST(ALT_005_pressures_in_range_count);
    RUN_TEST(ALT_005_a_spike_is_a_jump);
    RUN_TEST(ALT_006_acceleration_carries_it_on);
    RUN_TEST(ALT_007_heights_are_the_standard_atmospheres);
    return UNITY_END();
}
