/* SPDX-License-Identifier: Apache-2.0 */
/* The mixer beside its executable specification (specs/model): random and adversarial calls on
 * both, of which result and every bit of the object must be the same after each. */
#include "any.h"
#include "keel/flight/mixer.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/mixer.c"
#include "../../specs/model/range.c"

#define STEPS       1000000u
#define SEED        20260713u
#define SETUP_EVERY 64u

static keel_mixer_t mixer;
static keel_mixer_t model;

void setUp(void)
{
    any_from(SEED);
    memset(&mixer, 0, sizeof mixer);
    memset(&model, 0, sizeof model);
}

void tearDown(void)
{
}

/* A usual value, or one that breaks arithmetic that did not expect it. */
static float usually(float value, uint32_t chances)
{
    const float values[] = {NAN,      INFINITY,  -INFINITY, 0.0f,    -0.0f,      FLT_MIN,
                            -FLT_MIN, FLT_MAX,   -FLT_MAX,  1.0f,    -1.0f,      2.0f,
                            -2.0f,    0x1p-149f, 0.125f,    -0.125f, any_bits(), any_bits()};

    return one_in(chances) ? values[any() % (sizeof values / sizeof values[0])] : value;
}

static bool set_up(void)
{
    const keel_mixer_geometry_t *const tables[] = {
        &keel_mixer_quad_x, &keel_mixer_quad_plus, &keel_mixer_hexa_x, &keel_mixer_hexa_plus,
        &keel_mixer_octo_x, &keel_mixer_octo_plus, &keel_mixer_y6,
    };
    keel_mixer_config_t config;
    keel_status_t expected;

    memset(&config, 0, sizeof config);
    config.geometry = *tables[any() % 7u];
    if (one_in(2u)) {
        config.geometry.motors = (uint8_t)(2u + (any() % 8u));
        for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
            config.geometry.motor[i].roll = usually(between(-1.0f, 1.0f), 256u);
            config.geometry.motor[i].pitch = usually(between(-1.0f, 1.0f), 256u);
            config.geometry.motor[i].yaw = usually(between(-1.0f, 1.0f), 256u);
        }
    }
    config.idle = usually(between(KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX), 64u);
    config.highest = usually(between(KEEL_MIXER_HIGHEST_MIN, 1.0f), 64u);
    config.yaw_share = usually(between(0.0f, KEEL_MIXER_YAW_SHARE_MAX), 64u);
    expected = model_mixer_init(&model, &config);
    TEST_ASSERT_EQUAL(model_mixer_check(&config), keel_mixer_check(&config));
    TEST_ASSERT_EQUAL(expected, keel_mixer_init(&mixer, &config));
    return expected == KEEL_OK;
}

static void MIX_004_every_step_is_the_specified_one(void)
{
    uint32_t given_way[5] = {0u};
    bool made = false;

    for (uint32_t n = 0u; n < STEPS; n++) {
        const float size = between(0.0f, 1.25f);
        const bool armed = !one_in(64u);
        keel_mixer_command_t command;

        if ((n % SETUP_EVERY) == 0u) {
            made = set_up() || made;
        }
        command.roll = usually(between(-size, size), 64u);
        command.pitch = usually(between(-size, size), 64u);
        command.yaw = usually(between(-size, size), 64u);
        command.thrust = usually(between(-0.1f, 1.1f), 64u);
        if (made) {
            model_mixer_step(&model, &command, armed);
            keel_mixer_step(&mixer, &command, armed);
        }
        TEST_ASSERT_EQUAL_MEMORY(&model, &mixer, sizeof mixer);
        for (uint32_t i = 0u; i < 5u; i++) {
            given_way[i] += ((uint32_t)mixer.limited >> i) & 1u;
        }
    }
    for (uint32_t i = 0u; i < 5u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 64u, given_way[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(MIX_004_every_step_is_the_specified_one);
    return UNITY_END();
}
