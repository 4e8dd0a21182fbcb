/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/mixer.h. Expected values are worked out by hand, or in double precision
 * from the geometry. Sweeps over commands are in test_mixer_equations.c. */
#include "keel/flight/mixer.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define IDLE    0.25f
#define HIGHEST 0.75f
#define PI      3.14159265358979323846

static keel_mixer_config_t config;
static keel_mixer_t mixer;

void setUp(void)
{
    config = (keel_mixer_config_t){keel_mixer_quad_x, IDLE, HIGHEST, 0.0f};
    memset(&mixer, 0x55, sizeof mixer);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_init(&mixer, &config));
}

void tearDown(void)
{
}

static double smaller(double x, double y)
{
    return (x < y) ? x : y;
}

static double larger(double x, double y)
{
    return (x > y) ? x : y;
}

static double magnitude(double x)
{
    return (x < 0.0) ? -x : x;
}

/* The series, as far as a double shows it from -360 to 360 degrees. */
static double sine(double degrees)
{
    const double x = degrees * PI / 180.0;
    double term = x;
    double sum = x;

    for (uint32_t n = 1u; n < 25u; n++) {
        term *= -(x * x) / ((2.0 * n) * ((2.0 * n) + 1.0));
        sum += term;
    }
    return sum;
}

static double cosine(double degrees)
{
    return sine(90.0 - degrees);
}

static void step(float roll, float pitch, float yaw, float thrust)
{
    const keel_mixer_command_t command = {roll, pitch, yaw, thrust};

    keel_mixer_step(&mixer, &command, true);
}

static void expect(uint8_t limited, float m0, float m1, float m2, float m3)
{
    const float expected[KEEL_MIXER_MOTORS] = {m0, m1, m2, m3};

    TEST_ASSERT_EQUAL_MEMORY(expected, mixer.output, sizeof expected);
    TEST_ASSERT_EQUAL_HEX8(limited, mixer.limited);
}

/* --- Tables ----------------------------------------------------------------------------------- */

/* Arms stand at angles from the front, clockwise; turns are 1 for counter-clockwise. A motor's
 * thrust on the right (sine) rolls to the left, in front (cosine) it raises the nose; turning
 * counter-clockwise, it turns the craft clockwise. Factors are parts of the largest of an axis. */
static void expect_table(const keel_mixer_geometry_t *geometry, uint32_t motors,
                         const double degrees[], const int turns[])
{
    double widest = 0.0;
    double longest = 0.0;

    for (uint32_t i = 0u; i < motors; i++) {
        widest = larger(widest, magnitude(sine(degrees[i])));
        longest = larger(longest, magnitude(cosine(degrees[i])));
    }
    TEST_ASSERT_EQUAL_UINT8(motors, geometry->motors);
    for (uint32_t i = 0u; i < motors; i++) {
        const double roll = -sine(degrees[i]) / widest;
        const double pitch = cosine(degrees[i]) / longest;

        TEST_ASSERT_TRUE(magnitude(roll - (double)geometry->motor[i].roll) < 1.0e-7);
        TEST_ASSERT_TRUE(magnitude(pitch - (double)geometry->motor[i].pitch) < 1.0e-7);
        TEST_ASSERT_EQUAL_FLOAT((float)turns[i], geometry->motor[i].yaw);
    }
}

static void MIX_001_tables_are_those_of_their_arms(void)
{
    const int turns[] = {1, -1, 1, -1, 1, -1, 1, -1};

    expect_table(&keel_mixer_quad_x, 4u, (const double[]){45, 135, 225, 315}, turns);
    expect_table(&keel_mixer_quad_plus, 4u, (const double[]){0, 90, 180, 270}, turns);
    expect_table(&keel_mixer_hexa_x, 6u, (const double[]){30, 90, 150, 210, 270, 330}, turns);
    expect_table(&keel_mixer_hexa_plus, 6u, (const double[]){0, 60, 120, 180, 240, 300}, turns);
    expect_table(&keel_mixer_octo_x, 8u,
                 (const double[]){22.5, 67.5, 112.5, 157.5, 202.5, 247.5, 292.5, 337.5}, turns);
    expect_table(&keel_mixer_octo_plus, 8u, (const double[]){0, 45, 90, 135, 180, 225, 270, 315},
                 turns);
    expect_table(&keel_mixer_y6, 6u, (const double[]){60, 60, 180, 180, 300, 300}, turns);
}

/* What is asked of one axis reaches no other, and does not change thrust. */
static void MIX_001_axes_of_tables_are_independent(void)
{
    const keel_mixer_geometry_t *const tables[] = {
        &keel_mixer_quad_x, &keel_mixer_quad_plus, &keel_mixer_hexa_x, &keel_mixer_hexa_plus,
        &keel_mixer_octo_x, &keel_mixer_octo_plus, &keel_mixer_y6,
    };

    for (uint32_t t = 0u; t < (sizeof tables / sizeof tables[0]); t++) {
        double sum[6] = {0.0};

        for (uint32_t i = 0u; i < tables[t]->motors; i++) {
            const keel_mixer_motor_t *const motor = &tables[t]->motor[i];

            sum[0] += (double)motor->roll;
            sum[1] += (double)motor->pitch;
            sum[2] += (double)motor->yaw;
            sum[3] += (double)motor->roll * (double)motor->pitch;
            sum[4] += (double)motor->roll * (double)motor->yaw;
            sum[5] += (double)motor->pitch * (double)motor->yaw;
        }
        for (uint32_t i = 0u; i < 6u; i++) {
            TEST_ASSERT_TRUE(magnitude(sum[i]) < 1.0e-6);
        }
    }
}

/* --- Configurations --------------------------------------------------------------------------- */

static void refuses(keel_status_t status)
{
    keel_mixer_t before;

    memcpy(&before, &mixer, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_mixer_check(&config));
    TEST_ASSERT_EQUAL(status, keel_mixer_init(&mixer, &config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &mixer, sizeof mixer);
    config = (keel_mixer_config_t){keel_mixer_quad_x, IDLE, HIGHEST, 0.0f};
}

static void MIX_001_bad_numbers_of_motors_are_refused(void)
{
    const uint8_t bad[] = {0u, 2u, 9u, 255u};

    for (uint32_t i = 0u; i < sizeof bad; i++) {
        config.geometry.motors = bad[i];
        config.idle = NAN; /* told later */
        refuses(KEEL_ERR_MOTORS);
    }
}

static void MIX_001_bad_factors_are_refused(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY, 0x1.000002p+0f, -0x1.000002p+0f};

    for (uint32_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        config.geometry.motor[0].roll = bad[i];
        refuses(KEEL_ERR_GEOMETRY);
        config.geometry.motor[1].pitch = bad[i];
        refuses(KEEL_ERR_GEOMETRY);
        config.geometry.motor[3].yaw = bad[i];
        config.highest = 2.0f; /* told later */
        refuses(KEEL_ERR_GEOMETRY);
    }
}

/* A motor's factor about roll, pitch or yaw. */
static float *factor(uint32_t motor, uint32_t axis)
{
    keel_mixer_motor_t *const factors = &config.geometry.motor[motor];
    float *const axes[] = {&factors->roll, &factors->pitch, &factors->yaw};

    return axes[axis];
}

/* Without the motors that turn it one way about an axis. */
static void MIX_001_axes_without_authority_are_refused(void)
{
    const double weak = 0x1.fffffep-4;

    for (uint32_t axis = 0u; axis < 3u; axis++) {
        config.geometry = keel_mixer_quad_x;
        for (uint32_t i = 0u; i < 4u; i++) {
            *factor(i, axis) = (float)smaller((double)*factor(i, axis), weak);
        }
        refuses(KEEL_ERR_GEOMETRY);
        config.geometry = keel_mixer_quad_x;
        for (uint32_t i = 0u; i < 4u; i++) {
            *factor(i, axis) = (float)larger((double)*factor(i, axis), -weak);
        }
        refuses(KEEL_ERR_GEOMETRY);
    }
}

static void MIX_001_bad_ranges_are_refused(void)
{
    const float idle[] = {0.0f, 0x1.fffffep-6f, 0x1.000002p-2f, NAN, -0.25f};
    const float highest[] = {0x1.fffffep-2f, 0x1.000002p+0f, NAN, INFINITY};
    const float yaw_share[] = {-0x1p-149f, 0x1.000002p-2f, NAN, INFINITY};

    for (uint32_t i = 0u; i < (sizeof idle / sizeof idle[0]); i++) {
        config.idle = idle[i];
        refuses(KEEL_ERR_LIMITS);
    }
    for (uint32_t i = 0u; i < (sizeof highest / sizeof highest[0]); i++) {
        config.highest = highest[i];
        refuses(KEEL_ERR_LIMITS);
    }
    for (uint32_t i = 0u; i < (sizeof yaw_share / sizeof yaw_share[0]); i++) {
        config.yaw_share = yaw_share[i];
        refuses(KEEL_ERR_LIMITS);
    }
}

static void takes(void)
{
    memset(&mixer, 0x55, sizeof mixer);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_check(&config));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_init(&mixer, &config));
    TEST_ASSERT_EQUAL_MEMORY(&config, &mixer.config, sizeof config);
}

/* Three motors with just enough authority, and five more that are not looked at. */
static void MIX_001_the_ends_are_taken(void)
{
    memset(&config.geometry, 0xFF, sizeof config.geometry); /* NaN */
    config.geometry.motors = 3u;
    config.geometry.motor[0] = (keel_mixer_motor_t){0.125f, -0.125f, 1.0f};
    config.geometry.motor[1] = (keel_mixer_motor_t){-0.125f, 0.0f, -0.125f};
    config.geometry.motor[2] = (keel_mixer_motor_t){-1.0f, 0.125f, 0.125f};
    takes();
    config.idle = 0.03125f;
    config.highest = 0.5f;
    takes();
    config.highest = 1.0f;
    takes();
    config.yaw_share = 0.25f;
    takes();
}

static void MIX_002_a_made_mixer_is_stopped(void)
{
    takes();
    expect(0u, 0.0f, 0.0f, 0.0f, 0.0f);
}

/* --- Steps ------------------------------------------------------------------------------------ */

static void MIX_003_disarmed_is_exactly_zero(void)
{
    const keel_mixer_command_t command = {NAN, 0.1f, 0.2f, 1.0f};

    step(NAN, 0.1f, 0.2f, 1.0f);
    keel_mixer_step(&mixer, &command, false);
    expect(0u, 0.0f, 0.0f, 0.0f, 0.0f);
}

static void MIX_004_what_fits_is_put_out_as_asked_for(void)
{
    config.idle = 0.125f;
    config.highest = 1.0f;
    takes();
    step(0.125f, 0.0625f, 0.03125f, 0.5f);
    expect(0u, 0.53125f, 0.34375f, 0.65625f, 0.71875f);
    step(0.0f, 0.0f, 0.0f, 0.0f);
    expect(0u, 0.125f, 0.125f, 0.125f, 0.125f);
}

static void MIX_005_what_is_not_finite_counts_as_0(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};

    for (uint32_t i = 0u; i < 3u; i++) {
        step(bad[i], 0.0625f, 0.0f, 0.5f);
        expect(KEEL_MIXER_COMMAND, 0.5625f, 0.4375f, 0.4375f, 0.5625f);
        step(0.0625f, bad[i], 0.0f, 0.5f);
        expect(KEEL_MIXER_COMMAND, 0.4375f, 0.4375f, 0.5625f, 0.5625f);
        step(0.0f, 0.0625f, bad[i], 0.5f);
        expect(KEEL_MIXER_COMMAND, 0.5625f, 0.4375f, 0.4375f, 0.5625f);
        step(0.0f, 0.0f, 0.0f, bad[i]);
        expect(KEEL_MIXER_COMMAND, IDLE, IDLE, IDLE, IDLE);
    }
}

static void MIX_005_what_is_out_of_range_counts_as_its_end(void)
{
    /* Roll of 1 needs 2, of 0.5 there are: a quarter. */
    step(1.5f, 0.0f, 0.0f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_TILT, 0.25f, 0.25f, 0.75f, 0.75f);
    step(-1.5f, 0.0f, 0.0f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_TILT, 0.75f, 0.75f, 0.25f, 0.25f);
    step(0.0f, 1.5f, 0.0f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_TILT, 0.75f, 0.25f, 0.25f, 0.75f);
    step(0.0f, -1.5f, 0.0f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_TILT, 0.25f, 0.75f, 0.75f, 0.25f);
    step(0.0f, 0.0f, 1.5f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_YAW, 0.75f, 0.25f, 0.75f, 0.25f);
    step(0.0f, 0.0f, -1.5f, 0.5f);
    expect(KEEL_MIXER_COMMAND | KEEL_MIXER_YAW, 0.25f, 0.75f, 0.25f, 0.75f);
    step(0.0f, 0.0f, 0.0f, 1.5f);
    expect(KEEL_MIXER_COMMAND, HIGHEST, HIGHEST, HIGHEST, HIGHEST);
    step(0.0f, 0.0f, 0.0f, -0.5f);
    expect(KEEL_MIXER_COMMAND, IDLE, IDLE, IDLE, IDLE);
}

static void MIX_008_yaw_gives_way_first(void)
{
    /* Upwards there is 0.125, half of what is asked for. */
    step(0.0f, 0.0f, 0.25f, 0.75f);
    expect(KEEL_MIXER_YAW, 0.75f, 0.5f, 0.75f, 0.5f);
    /* Beside a roll both ends are in the way. */
    step(0.125f, 0.0f, 0.25f, 0.5f);
    expect(KEEL_MIXER_YAW, 0.5f, 0.25f, 0.75f, 0.5f);
    step(0.125f, 0.0f, -0.25f, 0.5f);
    expect(KEEL_MIXER_YAW, 0.25f, 0.5f, 0.5f, 0.75f);
}

/* Without a share neither idle nor full thrust leaves any yaw. */
static void MIX_009_a_share_of_yaw_is_done_at_every_thrust(void)
{
    step(0.0f, 0.0f, 0.25f, 1.0f);
    expect(KEEL_MIXER_YAW, HIGHEST, HIGHEST, HIGHEST, HIGHEST);
    step(0.0f, 0.0f, 0.25f, 0.0f);
    expect(KEEL_MIXER_YAW, IDLE, IDLE, IDLE, IDLE);

    config.yaw_share = 0.125f;
    takes();
    step(0.0f, 0.0f, 0.25f, 1.0f);
    expect(KEEL_MIXER_LOWERED | KEEL_MIXER_YAW, 0.75f, 0.5f, 0.75f, 0.5f);
    step(0.0f, 0.0f, 0.25f, 0.0f);
    expect(KEEL_MIXER_RAISED | KEEL_MIXER_YAW, 0.5f, 0.25f, 0.5f, 0.25f);
    step(0.0f, 0.0f, -0.0625f, 0.0f);
    expect(KEEL_MIXER_RAISED, 0.25f, 0.375f, 0.25f, 0.375f);
    /* Thrust that leaves room stays as it is. */
    step(0.0f, 0.0f, 0.125f, 0.5f);
    expect(0u, 0.625f, 0.375f, 0.625f, 0.375f);
}

/* The roll needs 3/8 of the span of 1/2: of what is left, half is kept. One that needs all of it
 * leaves none. */
static void MIX_009_roll_and_pitch_come_before_it(void)
{
    config.yaw_share = 0.125f;
    takes();
    step(0.1875f, 0.0f, 0.25f, 1.0f);
    expect(KEEL_MIXER_LOWERED | KEEL_MIXER_YAW, 0.375f, 0.25f, 0.75f, 0.625f);
    step(0.75f, 0.25f, 0.5f, 1.0f);
    expect(KEEL_MIXER_TILT | KEEL_MIXER_LOWERED | KEEL_MIXER_YAW, 0.375f, 0.25f, 0.625f, 0.75f);
}

static void MIX_007_thrust_gives_way_to_roll_and_pitch(void)
{
    step(0.125f, 0.0f, 0.0f, 0.0f);
    expect(KEEL_MIXER_RAISED, 0.25f, 0.25f, 0.5f, 0.5f);
    step(0.0f, 0.125f, 0.0f, 1.0f);
    expect(KEEL_MIXER_LOWERED, 0.75f, 0.5f, 0.5f, 0.75f);
    /* Not to yaw, of which nothing is left. */
    step(0.125f, 0.0f, 0.5f, 0.0f);
    expect(KEEL_MIXER_RAISED | KEEL_MIXER_YAW, 0.25f, 0.25f, 0.5f, 0.5f);
    step(0.0f, 0.0f, 0.5f, 1.0f);
    expect(KEEL_MIXER_YAW, 0.75f, 0.75f, 0.75f, 0.75f);
}

static void MIX_006_roll_and_pitch_keep_their_ratio(void)
{
    /* They need 2, of 0.5 there are: a quarter of each. */
    step(0.75f, 0.25f, 0.0f, 0.5f);
    expect(KEEL_MIXER_TILT, 0.375f, 0.25f, 0.625f, 0.75f);
    step(0.75f, 0.25f, 0.5f, 1.0f);
    expect(KEEL_MIXER_TILT | KEEL_MIXER_LOWERED | KEEL_MIXER_YAW, 0.375f, 0.25f, 0.625f, 0.75f);
    step(0.75f, 0.25f, 0.5f, 0.0f);
    expect(KEEL_MIXER_TILT | KEEL_MIXER_RAISED | KEEL_MIXER_YAW, 0.375f, 0.25f, 0.625f, 0.75f);
    /* Exactly the span: nothing gives way. */
    step(0.1875f, 0.0625f, 0.0f, 0.5f);
    expect(0u, 0.375f, 0.25f, 0.625f, 0.75f);
}

/* Floats where idle + (highest - idle) is above highest. */
static void MIX_007_full_thrust_that_is_rounded_upwards_is_all_there_is(void)
{
    config.idle = 0.09f;
    config.highest = 0.66f;
    takes();
    step(0.0f, 0.0f, 0.0f, 1.0f);
    expect(0u, 0.66f, 0.66f, 0.66f, 0.66f);
}

/* Scaled to the span, the sum of the lowest motor is rounded to below idle. */
static void MIX_004_what_is_rounded_beyond_the_range_is_its_end(void)
{
    config.idle = 0.04f;
    takes();
    step(0.01f, 0.35f, 0.0f, 0.5f);
    TEST_ASSERT_EQUAL_HEX8(KEEL_MIXER_TILT, mixer.limited);
    TEST_ASSERT_TRUE(mixer.output[1] == 0.04f);
    TEST_ASSERT_TRUE(mixer.output[3] == HIGHEST);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MIX_001_tables_are_those_of_their_arms);
    RUN_TEST(MIX_001_axes_of_tables_are_independent);
    RUN_TEST(MIX_001_bad_numbers_of_motors_are_refused);
    RUN_TEST(MIX_001_bad_factors_are_refused);
    RUN_TEST(MIX_001_axes_without_authority_are_refused);
    RUN_TEST(MIX_001_bad_ranges_are_refused);
    RUN_TEST(MIX_001_the_ends_are_taken);
    RUN_TEST(MIX_002_a_made_mixer_is_stopped);
    RUN_TEST(MIX_003_disarmed_is_exactly_zero);
    RUN_TEST(MIX_004_what_fits_is_put_out_as_asked_for);
    RUN_TEST(MIX_005_what_is_not_finite_counts_as_0);
    RUN_TEST(MIX_005_what_is_out_of_range_counts_as_its_end);
    RUN_TEST(MIX_008_yaw_gives_way_first);
    RUN_TEST(MIX_009_a_share_of_yaw_is_done_at_every_thrust);
    RUN_TEST(MIX_009_roll_and_pitch_come_before_it);
    RUN_TEST(MIX_007_thrust_gives_way_to_roll_and_pitch);
    RUN_TEST(MIX_006_roll_and_pitch_keep_their_ratio);
    RUN_TEST(MIX_007_full_thrust_that_is_rounded_upwards_is_all_there_is);
    RUN_TEST(MIX_004_what_is_rounded_beyond_the_range_is_its_end);
    return UNITY_END();
}
