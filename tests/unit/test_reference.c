/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/reference.h. Expected values are worked out by hand, or in double
 * precision from the formulas of section III-D.2 as reference.h gives them. */
#include "sticks.h"

#include <math.h>
#include <string.h>

void setUp(void)
{
    configure();
}

void tearDown(void)
{
}

/* The float below a positive one; of 0 -0.5. */
static float below(float value)
{
    uint32_t bits;

    if (value == 0.0f) {
        return -0.5f;
    }
    memcpy(&bits, &value, sizeof bits);
    bits--;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* The bits of all set-points, so that 0 and -0 differ. */
static void all_are_zero(void)
{
    const keel_reference_setpoints_t zero = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};

    TEST_ASSERT_EQUAL_MEMORY(&zero, &reference.setpoints, sizeof zero);
}

static void init_refuses(keel_status_t status)
{
    keel_reference_t before;

    memcpy(&before, &reference, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_reference_init(&reference, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &reference, sizeof reference);
}

static void has_range(float *value, float least, float greatest, keel_status_t status)
{
    const float good = *value;
    const float bad[] = {below(least), farther(greatest), -greatest, INFINITY, -INFINITY, NAN};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *value = bad[i];
        init_refuses(status);
    }
    *value = least;
    make();
    *value = greatest;
    make();
    *value = good;
    memset(&reference, 0x55, sizeof reference);
}

static void REF_001_bad_expos_are_refused(void)
{
    has_range(&config.roll.expo, 0.0f, 1.0f, KEEL_ERR_GAIN);
    has_range(&config.pitch.expo, 0.0f, 1.0f, KEEL_ERR_GAIN);
    has_range(&config.yaw.expo, 0.0f, 1.0f, KEEL_ERR_GAIN);
    has_range(&config.climb.expo, 0.0f, 1.0f, KEEL_ERR_GAIN);
}

static void REF_001_bad_dead_bands_are_refused(void)
{
    const float least = 1.0f / 4096.0f;

    has_range(&config.roll.dead_band, least, 0.5f, KEEL_ERR_LIMITS);
    has_range(&config.pitch.dead_band, least, 0.5f, KEEL_ERR_LIMITS);
    has_range(&config.yaw.dead_band, least, 0.5f, KEEL_ERR_LIMITS);
    has_range(&config.climb.dead_band, least, 0.5f, KEEL_ERR_LIMITS);
}

static void REF_001_bad_limits_are_refused(void)
{
    const float least = 1.0f / 1024.0f;

    has_range(&config.limits.roll_rate, least, 64.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.pitch_rate, least, 64.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.yaw_rate, least, 64.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.heading_rate, least, 64.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.tilt, least, 1.5f, KEEL_ERR_LIMITS);
    has_range(&config.limits.speed, least, 100.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.climb_rate, least, 100.0f, KEEL_ERR_LIMITS);
    has_range(&config.limits.descent_rate, least, 100.0f, KEEL_ERR_LIMITS);
}

static void REF_002_made_with_all_setpoints_zero(void)
{
    make();
    all_are_zero();
    TEST_ASSERT_EQUAL_MEMORY(&config.limits, &reference.limits, sizeof config.limits);
}

static void REF_003_curves_as_configured(void)
{
    make();
    TEST_ASSERT_EQUAL_FLOAT(0.25f, reference.pitch.dead_band);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 4.0f / 3.0f, reference.pitch.scale);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, reference.pitch.linear);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, reference.pitch.expo);
    TEST_ASSERT_EQUAL_FLOAT(0.0625f, reference.climb.dead_band);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 16.0f / 15.0f, reference.climb.scale);
    TEST_ASSERT_EQUAL_FLOAT(0.75f, reference.climb.linear);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, reference.climb.expo);
}

static void step_refuses(float roll, float pitch, float yaw, float climb)
{
    const keel_reference_sticks_t sticks = {roll, pitch, yaw, climb};
    keel_reference_t before;

    memcpy(&before, &reference, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_reference_step(&reference, &sticks));
    TEST_ASSERT_EQUAL_MEMORY(&before, &reference, sizeof reference);
}

static void REF_004_bad_sticks_are_held(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 1.0000001f, -1.0000001f};

    make();
    (void)at(0.75f, -0.75f, 0.75f, -0.75f);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        step_refuses(bad[i], 1.0f, 1.0f, 1.0f);
        step_refuses(1.0f, bad[i], 1.0f, 1.0f);
        step_refuses(1.0f, 1.0f, bad[i], 1.0f);
        step_refuses(1.0f, 1.0f, 1.0f, bad[i]);
    }
}

/* Beyond the dead band, stretched: roll (3/4 - 1/2) 2 = 1/2; pitch (5/8 - 1/4) 4/3 = 1/2, cubed
 * 1/8; yaw (9/16 - 1/8) 8/7 = 1/2, half of it straight and half cubed: 5/16; climb
 * (17/32 - 1/16) 16/15 = 1/2, 3/4 1/2 + 1/4 1/8 = 13/32. */
static void REF_005_the_formulas_by_hand(void)
{
    keel_reference_setpoints_t setpoints;

    make();
    setpoints = at(0.75f, -0.625f, 0.5625f, 0.53125f);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, setpoints.roll_rate);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.375f, setpoints.pitch_rate);
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, 5.0f * 0.3125f, setpoints.yaw_rate);
    TEST_ASSERT_FLOAT_WITHIN(3e-6f, 7.0f * 0.3125f, setpoints.heading_rate);
    TEST_ASSERT_FLOAT_WITHIN(5e-6f, 13.0f * 0.40625f, setpoints.climb_rate);
    /* Rounded off: 1/2 (1 - 0.292893/64) = 0.497712; 1/8 (1 - 0.292893/4) = 0.115847. */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.248856f, setpoints.roll);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, -0.0579235f, setpoints.pitch);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 5.474830f, setpoints.right);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.274318f, setpoints.forward);
    setpoints = at(0.0f, 0.0f, 0.0f, -0.53125f);
    TEST_ASSERT_FLOAT_WITHIN(7e-6f, -17.0f * 0.40625f, setpoints.climb_rate);
}

static void REF_006_the_end_of_the_stick_is_exactly_the_limit(void)
{
    keel_reference_setpoints_t setpoints;

    make();
    setpoints = at(1.0f, 0.0f, 1.0f, 1.0f);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, setpoints.roll_rate);
    TEST_ASSERT_EQUAL_FLOAT(5.0f, setpoints.yaw_rate);
    TEST_ASSERT_EQUAL_FLOAT(7.0f, setpoints.heading_rate);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, setpoints.roll);
    TEST_ASSERT_EQUAL_FLOAT(11.0f, setpoints.right);
    TEST_ASSERT_EQUAL_FLOAT(13.0f, setpoints.climb_rate);
    setpoints = at(0.0f, -1.0f, -1.0f, -1.0f);
    TEST_ASSERT_EQUAL_FLOAT(-3.0f, setpoints.pitch_rate);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, setpoints.yaw_rate);
    TEST_ASSERT_EQUAL_FLOAT(-0.5f, setpoints.pitch);
    TEST_ASSERT_EQUAL_FLOAT(11.0f, setpoints.forward);
    TEST_ASSERT_EQUAL_FLOAT(-17.0f, setpoints.climb_rate);
}

static void REF_007_zero_within_the_dead_band(void)
{
    make();
    (void)at(1.0f, 1.0f, 1.0f, 1.0f);
    (void)at(0.0f, 0.0f, 0.0f, 0.0f);
    all_are_zero();
    (void)at(-0.0f, -0.0f, -0.0f, -0.0f);
    all_are_zero();
    (void)at(0.5f, 0.25f, 0.125f, 0.0625f);
    all_are_zero();
    (void)at(-0.5f, -0.25f, -0.125f, -0.0625f);
    all_are_zero();
}

/* The first float beyond a dead band asks for something, and for little: there is no step. */
static void REF_007_nothing_but_the_dead_band_is_zero(void)
{
    const keel_reference_sticks_t sticks = {farther(0.5f), farther(-0.25f), farther(0.125f),
                                            farther(-0.0625f)};
    keel_reference_setpoints_t setpoints;

    make();
    setpoints = at(sticks.roll, sticks.pitch, sticks.yaw, sticks.climb);
    TEST_ASSERT_TRUE((setpoints.roll_rate > 0.0f) && (setpoints.roll_rate < 1e-6f));
    TEST_ASSERT_TRUE((setpoints.pitch_rate < 0.0f) && (setpoints.pitch_rate > -1e-6f));
    TEST_ASSERT_TRUE((setpoints.yaw_rate > 0.0f) && (setpoints.yaw_rate < 1e-6f));
    TEST_ASSERT_TRUE((setpoints.climb_rate < 0.0f) && (setpoints.climb_rate > -1e-6f));
    TEST_ASSERT_TRUE((setpoints.roll > 0.0f) && (setpoints.pitch < 0.0f));
    TEST_ASSERT_TRUE((setpoints.right > 0.0f) && (setpoints.forward > 0.0f));
}

/* The smallest curve and limit: still a normal number. */
static void REF_007_no_setpoint_is_too_small(void)
{
    const float least = KEEL_REFERENCE_DEAD_BAND_MIN;

    config.roll = (keel_reference_shape_t){least, 1.0f};
    config.limits.roll_rate = KEEL_REFERENCE_LIMIT_MIN;
    make();
    TEST_ASSERT_TRUE(isnormal(at(farther(least), 0.0f, 0.0f, 0.0f).roll_rate));
}

/* Each stick on either side and in the centre, with each side of the others: every set-point has
 * the sign of its stick, and none is beyond its limit. */
static void REF_006_each_side_of_each_stick(void)
{
    make();
    for (int i = 0; i < 81; i++) {
        const float roll = (float)((i % 3) - 1);
        const float pitch = (float)(((i / 3) % 3) - 1);
        const float yaw = (float)(((i / 9) % 3) - 1);
        const float climb = (float)((i / 27) - 1);
        const keel_reference_setpoints_t setpoints = at(roll, pitch, yaw, climb);

        TEST_ASSERT_EQUAL_FLOAT(2.0f * roll, setpoints.roll_rate);
        TEST_ASSERT_EQUAL_FLOAT(3.0f * pitch, setpoints.pitch_rate);
        TEST_ASSERT_EQUAL_FLOAT(5.0f * yaw, setpoints.yaw_rate);
        TEST_ASSERT_EQUAL_FLOAT(7.0f * yaw, setpoints.heading_rate);
        TEST_ASSERT_EQUAL_FLOAT((climb > 0.0f) ? 13.0f : (17.0f * climb), setpoints.climb_rate);
        TEST_ASSERT_TRUE(fabsf(setpoints.roll) <= 0.5f);
        TEST_ASSERT_TRUE(fabsf(setpoints.forward) <= 11.0f);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(REF_001_bad_expos_are_refused);
    RUN_TEST(REF_001_bad_dead_bands_are_refused);
    RUN_TEST(REF_001_bad_limits_are_refused);
    RUN_TEST(REF_002_made_with_all_setpoints_zero);
    RUN_TEST(REF_003_curves_as_configured);
    RUN_TEST(REF_004_bad_sticks_are_held);
    RUN_TEST(REF_005_the_formulas_by_hand);
    RUN_TEST(REF_006_the_end_of_the_stick_is_exactly_the_limit);
    RUN_TEST(REF_006_each_side_of_each_stick);
    RUN_TEST(REF_007_zero_within_the_dead_band);
    RUN_TEST(REF_007_nothing_but_the_dead_band_is_zero);
    RUN_TEST(REF_007_no_setpoint_is_too_small);
    return UNITY_END();
}
