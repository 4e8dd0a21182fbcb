/* SPDX-License-Identifier: Apache-2.0 */
/* The equations at the head of keel/flight/mixer.h in double precision, beside the mixer. These are
 * hundreds of thousands of steps; the others are in test_mixer.c. */
#include "any.h"
#include "keel/flight/mixer.h"
#include "unity.h"

#include <string.h>

#define CASES  100000u
#define MARGIN 0x1p-21 /* What rounding may add up to, in parts of the greatest output. */

static keel_mixer_config_t config;
static keel_mixer_t mixer;

void setUp(void)
{
    any_from(1u);
    config = (keel_mixer_config_t){keel_mixer_quad_x, 0.25f, 0.75f, 0.0f};
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

static void step(float roll, float pitch, float yaw, float thrust)
{
    const keel_mixer_command_t command = {roll, pitch, yaw, thrust};

    keel_mixer_step(&mixer, &command, true);
}

/* What the rounding of idle + (highest - idle) adds is not taken for a lack of thrust. */
static void MIX_007_full_thrust_alone_never_gives_way(void)
{
    for (uint32_t n = 0u; n < CASES; n++) {
        config.idle = between(KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX);
        config.highest = between(KEEL_MIXER_HIGHEST_MIN, 1.0f);
        TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_init(&mixer, &config));
        step(0.0f, 0.0f, 0.0f, 1.0f);
        TEST_ASSERT_EQUAL_HEX8(0u, mixer.limited);
        TEST_ASSERT_TRUE(magnitude((double)mixer.output[0] - (double)config.highest) < MARGIN);
    }
}

/* The torques that outputs amount to: those of a quadcopter's X are a quarter of the sums. */
static void MIX_006_the_ratio_holds_within_rounding(void)
{
    uint32_t scaled = 0u;

    for (uint32_t n = 0u; n < CASES; n++) {
        const double roll = (double)between(-1.0f, 1.0f);
        const double pitch = (double)between(-1.0f, 1.0f);
        double rolled = 0.0;
        double pitched = 0.0;
        double part;

        step((float)roll, (float)pitch, 0.0f, between(0.0f, 1.0f));
        for (uint32_t i = 0u; i < 4u; i++) {
            rolled += (double)mixer.output[i] * (double)config.geometry.motor[i].roll / 4.0;
            pitched += (double)mixer.output[i] * (double)config.geometry.motor[i].pitch / 4.0;
        }
        /* The quadcopter's tilts span twice the sum of both torques. */
        part = smaller(1.0, 0.5 / (2.0 * (magnitude(roll) + magnitude(pitch))));
        TEST_ASSERT_TRUE(magnitude(rolled - (part * roll)) < MARGIN);
        TEST_ASSERT_TRUE(magnitude(pitched - (part * pitch)) < MARGIN);
        TEST_ASSERT_BITS((uint8_t)KEEL_MIXER_YAW, 0u, mixer.limited);
        scaled += ((mixer.limited & KEEL_MIXER_TILT) != 0u) ? 1u : 0u;
    }
    TEST_ASSERT_GREATER_THAN_UINT32(CASES / 2u, scaled);
}

/* What is kept for yaw of what roll and pitch, which take so much, leave of the span. */
static double kept_of(double yaw, double taken)
{
    const double span = (double)mixer.config.highest - (double)mixer.config.idle;

    return smaller(smaller(magnitude(yaw), (double)mixer.config.yaw_share),
                   larger(0.0, (span - taken) / 2.0));
}

/* Without any last clamp. */
static void expected_of(const keel_mixer_command_t *command, double output[])
{
    const keel_mixer_geometry_t *const geometry = &mixer.config.geometry;
    const double idle = (double)mixer.config.idle;
    const double highest = (double)mixer.config.highest;
    const double span = highest - idle;
    double tilt[KEEL_MIXER_MOTORS];
    double least = 9.0;
    double most = -9.0;
    double part = 1.0;
    double kept;
    double base = idle + ((double)command->thrust * span);

    for (uint32_t i = 0u; i < geometry->motors; i++) {
        tilt[i] = ((double)geometry->motor[i].roll * (double)command->roll) +
                  ((double)geometry->motor[i].pitch * (double)command->pitch);
        least = smaller(least, tilt[i]);
        most = larger(most, tilt[i]);
    }
    part = smaller(1.0, span / larger(most - least, 1.0e-9));
    kept = kept_of((double)command->yaw, part * (most - least));
    base = smaller(larger(base, idle - (part * least) + kept), highest - (part * most) - kept);
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        output[i] = base + (part * tilt[i]);
    }
    part = 1.0;
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        const double turn = (double)geometry->motor[i].yaw * (double)command->yaw;
        const double room = (turn < 0.0) ? (output[i] - idle) : (highest - output[i]);

        part = smaller(part, larger(room, 0.0) / larger(magnitude(turn), 1.0e-9));
    }
    for (uint32_t i = 0u; i < geometry->motors; i++) {
        output[i] += part * (double)geometry->motor[i].yaw * (double)command->yaw;
    }
}

/* Any command, on the geometry that is configured. */
static void check_any_step(double margin)
{
    const float size = between(0.0f, 1.0f);
    const keel_mixer_command_t command = {between(-size, size), between(-size, size),
                                          between(-1.0f, 1.0f), between(0.0f, 1.0f)};
    double expected[KEEL_MIXER_MOTORS];

    config.idle = between(KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX);
    config.highest = between(KEEL_MIXER_HIGHEST_MIN, 1.0f);
    config.yaw_share = one_in(4u) ? 0.0f : between(0.0f, KEEL_MIXER_YAW_SHARE_MAX);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_init(&mixer, &config));
    keel_mixer_step(&mixer, &command, true);
    expected_of(&command, expected);
    for (uint32_t i = 0u; i < config.geometry.motors; i++) {
        TEST_ASSERT_TRUE(magnitude((double)mixer.output[i] - expected[i]) < margin);
        TEST_ASSERT_TRUE(mixer.output[i] >= config.idle);
        TEST_ASSERT_TRUE(mixer.output[i] <= config.highest);
    }
}

static void MIX_004_outputs_are_those_of_the_equations(void)
{
    const keel_mixer_geometry_t *const tables[] = {
        &keel_mixer_quad_x, &keel_mixer_quad_plus, &keel_mixer_hexa_x, &keel_mixer_hexa_plus,
        &keel_mixer_octo_x, &keel_mixer_octo_plus, &keel_mixer_y6,
    };

    for (uint32_t n = 0u; n < CASES; n++) {
        config.geometry = *tables[n % 7u];
        check_any_step(MARGIN);
    }
}

/* The yaw torque of a quadcopter's X, from what its outputs amount to: the share of it is done
 * beside any thrust, roll and pitch, as far as these leave room. */
static void MIX_009_the_share_is_done(void)
{
    uint32_t needed = 0u;

    for (uint32_t n = 0u; n < CASES; n++) {
        const float size = between(0.0f, 0.25f);
        const keel_mixer_command_t command = {between(-size, size), between(-size, size),
                                              between(-1.0f, 1.0f), one_in(2u) ? 0.0f : 1.0f};
        const double taken = 2.0 *
                             (magnitude((double)command.roll) + magnitude((double)command.pitch));
        double turned = 0.0;

        config.yaw_share = between(0.0f, KEEL_MIXER_YAW_SHARE_MAX);
        TEST_ASSERT_EQUAL(KEEL_OK, keel_mixer_init(&mixer, &config));
        keel_mixer_step(&mixer, &command, true);
        for (uint32_t i = 0u; i < 4u; i++) {
            turned += (double)mixer.output[i] * (double)config.geometry.motor[i].yaw / 4.0;
        }
        turned = (command.yaw < 0.0f) ? -turned : turned;
        TEST_ASSERT_TRUE(turned > (kept_of((double)command.yaw, taken) - MARGIN));
        needed += ((mixer.limited & KEEL_MIXER_YAW) != 0u) ? 1u : 0u;
    }
    TEST_ASSERT_GREATER_THAN_UINT32(CASES / 2u, needed);
}

/* Three to eight motors, wherever they are, that can be flown. How much the rounding of one moves
 * the others, by the part of the yaw that fits, grows as its own yaw gets small. */
static void MIX_004_so_are_those_of_any_airframe(void)
{
    for (uint32_t n = 0u; n < CASES; n++) {
        config = (keel_mixer_config_t){.idle = 0.25f, .highest = 0.75f};
        config.geometry.motors = (uint8_t)(3u + (n % 6u));
        do {
            for (uint32_t i = 0u; i < config.geometry.motors; i++) {
                config.geometry.motor[i].roll = between(-1.0f, 1.0f);
                config.geometry.motor[i].pitch = between(-1.0f, 1.0f);
                config.geometry.motor[i].yaw = between(0.5f, 1.0f) * (one_in(2u) ? 1.0f : -1.0f);
            }
        } while (keel_mixer_check(&config) != KEEL_OK);
        check_any_step(4.0 * MARGIN);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MIX_007_full_thrust_alone_never_gives_way);
    RUN_TEST(MIX_006_the_ratio_holds_within_rounding);
    RUN_TEST(MIX_004_outputs_are_those_of_the_equations);
    RUN_TEST(MIX_004_so_are_those_of_any_airframe);
    RUN_TEST(MIX_009_the_share_is_done);
    return UNITY_END();
}
