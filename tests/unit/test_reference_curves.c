/* SPDX-License-Identifier: Apache-2.0 */
/* Curves of keel/flight/reference.h over the whole of the sticks: bounded, monotone, odd, and
 * limited together. These are a million steps; the others are in test_reference.c. */
#include "sticks.h"

#include <math.h>

void setUp(void)
{
    configure();
}

void tearDown(void)
{
}

/* For dead bands and expos that are no round numbers, too. */
static void REF_006_the_end_is_reached_whatever_the_curve(void)
{
    for (uint32_t i = 1u; i < 2000u; i++) {
        config.roll = (keel_reference_shape_t){(float)i / 4001.0f, (float)i / 2003.0f};
        make();
        TEST_ASSERT_TRUE(at(1.0f, 0.0f, 0.0f, 0.0f).roll_rate == 2.0f);
    }
}

static void none_is_beyond(float stick)
{
    const keel_reference_limits_t *const limits = &config.limits;
    const keel_reference_setpoints_t setpoints = at(stick, -0.5f * stick, stick, stick);

    TEST_ASSERT_TRUE(fabsf(setpoints.roll_rate) <= limits->roll_rate);
    TEST_ASSERT_TRUE(fabsf(setpoints.pitch_rate) <= limits->pitch_rate);
    TEST_ASSERT_TRUE(fabsf(setpoints.yaw_rate) <= limits->yaw_rate);
    TEST_ASSERT_TRUE(fabsf(setpoints.heading_rate) <= limits->heading_rate);
    TEST_ASSERT_TRUE(fabsf(setpoints.roll) <= limits->tilt);
    TEST_ASSERT_TRUE(fabsf(setpoints.pitch) <= limits->tilt);
    TEST_ASSERT_TRUE(fabsf(setpoints.forward) <= limits->speed);
    TEST_ASSERT_TRUE(fabsf(setpoints.right) <= limits->speed);
    TEST_ASSERT_TRUE(setpoints.climb_rate <= limits->climb_rate);
    TEST_ASSERT_TRUE(setpoints.climb_rate >= -limits->descent_rate);
}

/* The last floats before the end are where rounding could lead beyond it. */
static void REF_006_no_setpoint_is_beyond_its_limit(void)
{
    config.limits = (keel_reference_limits_t){3.3f, 3.7f, 2.1f, 1.7f, 0.61f, 7.3f, 4.1f, 1.9f};
    for (uint32_t i = 1u; i < 500u; i++) {
        const keel_reference_shape_t shape = {(float)i / 1001.0f, (float)i / 503.0f};

        config.roll = shape;
        config.pitch = shape;
        config.yaw = shape;
        config.climb = shape;
        make();
        for (uint32_t ulps = 0u; ulps < 16u; ulps++) {
            none_is_beyond(1.0f - ((float)ulps / 16777216.0f));
            none_is_beyond(((float)ulps / 16777216.0f) - 1.0f);
        }
    }
}

static void is_not_below(const keel_reference_setpoints_t *next,
                         const keel_reference_setpoints_t *last)
{
    TEST_ASSERT_TRUE(next->roll_rate >= last->roll_rate);
    TEST_ASSERT_TRUE(next->roll >= last->roll);
    TEST_ASSERT_TRUE(next->right >= last->right);
    TEST_ASSERT_TRUE(next->yaw_rate >= last->yaw_rate);
    TEST_ASSERT_TRUE(next->heading_rate >= last->heading_rate);
    TEST_ASSERT_TRUE(next->climb_rate >= last->climb_rate);
}

/* Float by float from a positive number on, and the same on the other side of the centre. */
static void is_monotone_from(float x, uint32_t floats)
{
    keel_reference_setpoints_t last = at(x, 0.7f, x, x);
    keel_reference_setpoints_t last_mirrored = at(-x, 0.7f, -x, -x);

    for (uint32_t i = 0u; i < floats; i++) {
        const float y = farther(x);
        const keel_reference_setpoints_t next = at(y, 0.7f, y, y);
        const keel_reference_setpoints_t mirrored = at(-y, 0.7f, -y, -y);

        is_not_below(&next, &last);
        is_not_below(&last_mirrored, &mirrored);
        last = next;
        last_mirrored = mirrored;
        x = y;
    }
}

/* All the way; float by float about the dead bands, where curves are steep and at their ends. */
static void REF_008_monotone(void)
{
    keel_reference_setpoints_t last;

    make();
    last = at(-1.0f, 0.7f, -1.0f, -1.0f);
    for (int i = -4096; i <= 4096; i++) {
        const float x = (float)i / 4096.0f;
        const keel_reference_setpoints_t next = at(x, 0.7f, x, x);

        is_not_below(&next, &last);
        last = next;
    }
    is_monotone_from(0.4999f, 100000u);
    is_monotone_from(0.1249f, 100000u);
    is_monotone_from(0.75f, 100000u);
    is_monotone_from(1.0f - 0x1p-8f, 65536u);
}

static void is_opposite(float value, float other)
{
    TEST_ASSERT_TRUE((value == -other) && ((value != 0.0f) || !(signbit(value) || signbit(other))));
}

static void REF_009_odd(void)
{
    config.limits.descent_rate = config.limits.climb_rate;
    make();
    for (float x = 0.0f; x <= 1.0f; x += 0x1p-12f) {
        const float y = 1.0f - x;
        const keel_reference_setpoints_t one = at(x, y, x, x);
        const keel_reference_setpoints_t other = at(-x, -y, -x, -x);

        is_opposite(one.roll_rate, other.roll_rate);
        is_opposite(one.pitch_rate, other.pitch_rate);
        is_opposite(one.yaw_rate, other.yaw_rate);
        is_opposite(one.heading_rate, other.heading_rate);
        is_opposite(one.roll, other.roll);
        is_opposite(one.pitch, other.pitch);
        is_opposite(one.forward, other.forward);
        is_opposite(one.right, other.right);
        is_opposite(one.climb_rate, other.climb_rate);
    }
}

static double square(double x)
{
    return x * x;
}

/* The cosine up to a right angle, by its series. */
static double cosine(double x)
{
    double term = 1.0;
    double sum = 1.0;

    for (int n = 1; n < 24; n += 2) {
        term *= -(x * x) / (n * (n + 1));
        sum += term;
    }
    return sum;
}

/* The angle between the aircraft's vertical axis and the true one is that whose cosine is
 * cos(roll) cos(pitch), by the product of the rotations about both axes. */
static void REF_010_the_total_tilt_is_limited(void)
{
    const double tilt_max = 1.5 * (1.0 + 0x1p-22);
    const double speed_max = 11.0 * (1.0 + 0x1p-22);

    config.roll = (keel_reference_shape_t){KEEL_REFERENCE_DEAD_BAND_MIN, 0.0f};
    config.pitch = config.roll;
    config.limits.tilt = 1.5f;
    make();
    for (float x = -1.0f; x <= 1.0f; x += 0x1p-7f) {
        for (float y = -1.0f; y <= 1.0f; y += 0x1p-7f) {
            const keel_reference_setpoints_t setpoints = at(x, y, 0.0f, 0.0f);
            const double upright = cosine((double)setpoints.roll) * cosine((double)setpoints.pitch);
            const double speed2 = square((double)setpoints.forward) +
                                  square((double)setpoints.right);

            TEST_ASSERT_TRUE(upright >= cosine(tilt_max));
            TEST_ASSERT_TRUE(speed2 <= square(speed_max));
        }
    }
}

/* Round the edge of the sticks' square the speed is never short of its limit by more than 1.1 %:
 * sqrt(1 - k^2/4) is 0.98922. */
static void REF_010_little_is_lost_round_the_edge(void)
{
    config.roll = (keel_reference_shape_t){KEEL_REFERENCE_DEAD_BAND_MIN, 0.0f};
    config.pitch = config.roll;
    make();
    for (float x = -1.0f; x <= 1.0f; x += 0x1p-10f) {
        const keel_reference_setpoints_t setpoints = at(x, 1.0f, 0.0f, 0.0f);

        TEST_ASSERT_TRUE((square((double)setpoints.forward) + square((double)setpoints.right)) >=
                         square(11.0 * 0.98921));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(REF_006_the_end_is_reached_whatever_the_curve);
    RUN_TEST(REF_006_no_setpoint_is_beyond_its_limit);
    RUN_TEST(REF_008_monotone);
    RUN_TEST(REF_009_odd);
    RUN_TEST(REF_010_the_total_tilt_is_limited);
    RUN_TEST(REF_010_little_is_lost_round_the_edge);
    return UNITY_END();
}
