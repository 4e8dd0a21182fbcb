/* SPDX-License-Identifier: Apache-2.0 */
/* The cascade beside its executable specification (specs/model): random and adversarial numbers to
 * both, after each of which every bit of the cascade must be the same, and within its bounds. */
#include "any.h"
#include "cascades.h"

#include <float.h>

/* The models are part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/cascade.c"
#include "../../specs/model/cascade_parts.c"
#include "../../specs/model/filter.c"
#include "../../specs/model/pid.c"
#include "../../specs/model/pid_within.c"

#define STEPS       400000u
#define SETUP_EVERY 2048u
#define MODE_EVERY  256u
#define SEED        20241129u

static keel_cascade_t model;

void setUp(void)
{
    any_from(SEED);
    configure();
    memset(&cascade, 0, sizeof cascade);
    memset(&model, 0, sizeof model);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_cascade_init(&cascade, &config));
    TEST_ASSERT_EQUAL(KEEL_OK, model_cascade_init(&model, &config));
}

void tearDown(void)
{
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,     INFINITY, -INFINITY, 0.0f,       -0.0f,      0x1p-149f,
                            FLT_MAX, -FLT_MAX, 5.0e5f,    any_bits(), any_bits(), -5.1e5f};

    return values[any() % (sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(256u) ? awkward() : value;
}

static float about(float noise)
{
    return usually(between(-noise, noise));
}

/* Mostly good ones: whether a configuration is taken is the model's to say, too. */
static void set_up(void)
{
    keel_status_t expected;

    configure();
    for (uint32_t i = 0u; i < AXES; i++) {
        config.pid[i].gains.kp *= between(0.5f, 2.0f);
        config.pid[i].gains.ki *= one_in(4u) ? 0.0f : between(0.0f, 0.5f);
        config.pid[i].gains.kd = between(0.0f, 0.01f);
        config.pid[i].gains.kff = one_in(64u) ? awkward() : between(0.0f, 0.5f);
        config.pid[i].output_max *= one_in(64u) ? 1.5f : between(0.875f, 1.0f);
        config.reach[i] *= one_in(64u) ? awkward() : between(1.0f, 1.03125f);
    }
    config.reaction_s = usually(between(0.0625f, 0.5f));
    expected = model_cascade_init(&model, &config);
    TEST_ASSERT_EQUAL(expected, keel_cascade_init(&cascade, &config));
}

static void one_axis_is_specified(void)
{
    for (uint32_t i = 0u; i <= AXES; i++) {
        TEST_ASSERT_EQUAL(model_cascade_check(&config, i), keel_cascade_check(&config, i));
    }
}

static keel_cascade_estimate_t any_estimate(void)
{
    const float far = one_in(4u) ? 100.0f : 1.0f;
    const keel_cascade_estimate_t estimate = {.position = {about(far), about(far), about(far)},
                                              .velocity = {about(4.0f), about(4.0f), about(4.0f)},
                                              .forward_north = about(1.0f),
                                              .forward_east = about(1.0f),
                                              .has_place = !one_in(64u),
                                              .has_height = !one_in(64u)};

    return estimate;
}

/* One stage. */
static void step(void)
{
    const keel_cascade_estimate_t estimate = any_estimate();
    const keel_cascade_vector_t asked = one_in(2u) ? cascade.velocity
                                                   : (keel_cascade_vector_t){
                                                         about(8.0f), about(8.0f), about(5.0f)};
    const keel_cascade_vector_t place = {about(100.0f), about(100.0f), about(100.0f)};
    const keel_cascade_tilt_t tilt = one_in(2u) ? cascade.tilt
                                                : (keel_cascade_tilt_t){about(0.6f), about(0.6f)};
    const keel_cascade_rates_t rates = {one_in(2u) ? cascade.rates.roll : about(6.0f),
                                        one_in(2u) ? cascade.rates.pitch : about(6.0f), about(4.0f),
                                        one_in(2u) ? cascade.thrust : usually(between(0.0f, 1.0f))};
    const keel_attitude_vector_t rate = {about(6.0f), about(6.0f), about(4.0f)};
    const keel_attitude_vector_t down = {about(0.6f), about(0.6f), 0.9f};
    const uint32_t gave_way = one_in(2u) ? 0u : any();
    const bool valid = !one_in(64u);

    switch (any() % 4u) {
    case 0u:
        keel_cascade_rate_step(&cascade, rates, rate, gave_way);
        model_cascade_rate_step(&model, rates, rate, gave_way);
        break;
    case 1u:
        keel_cascade_angle_step(&cascade, tilt, down, valid);
        model_cascade_angle_step(&model, tilt, down, valid);
        break;
    case 2u:
        keel_cascade_velocity_step(&cascade, asked, &estimate);
        model_cascade_velocity_step(&model, asked, &estimate);
        break;
    default:
        keel_cascade_position_step(&cascade, place, &estimate);
        model_cascade_position_step(&model, place, &estimate);
        break;
    }
}

static void is_within(float value, float most)
{
    TEST_ASSERT_TRUE((value >= -most) && (value <= most));
}

static void is_bounded(void)
{
    is_within(cascade.command.roll, 1.0f);
    is_within(cascade.command.pitch, 1.0f);
    is_within(cascade.command.yaw, 1.0f);
    TEST_ASSERT_TRUE((cascade.command.thrust >= 0.0f) && (cascade.command.thrust <= 1.0f));
    TEST_ASSERT_TRUE((cascade.thrust >= 0.0f) && (cascade.thrust <= 1.0f));
    is_within(cascade.rates.roll, cascade.axis[KEEL_CASCADE_ROLL_RATE].reach);
    is_within(cascade.rates.pitch, cascade.axis[KEEL_CASCADE_PITCH_RATE].reach);
    is_within(cascade.tilt.roll, cascade.axis[KEEL_CASCADE_ROLL].reach);
    is_within(cascade.tilt.pitch, cascade.axis[KEEL_CASCADE_PITCH].reach);
    is_within(cascade.velocity.north, cascade.axis[KEEL_CASCADE_NORTH_SPEED].reach);
    is_within(cascade.velocity.east, cascade.axis[KEEL_CASCADE_EAST_SPEED].reach);
    is_within(cascade.velocity.up, cascade.axis[KEEL_CASCADE_CLIMB].reach);
}

static void CAS_004_every_step_is_the_specified_one(void)
{
    uint32_t running[AXES] = {0u};
    uint32_t held = 0u;
    uint32_t limited = 0u;

    for (uint32_t i = 0u; i < STEPS; i++) {
        if ((i % SETUP_EVERY) == 0u) {
            set_up();
            one_axis_is_specified();
        }
        if ((i % MODE_EVERY) == 0u) {
            const uint8_t mode = one_in(8u) ? (uint8_t)any() : (uint8_t)(any() % 6u);

            keel_cascade_enter(&cascade, mode);
            model_cascade_enter(&model, mode);
        }
        step();
        TEST_ASSERT_EQUAL_MEMORY(&model, &cascade, sizeof cascade);
        is_bounded();
        for (uint32_t k = 0u; k < AXES; k++) {
            running[k] += cascade.axis[k].running ? 1u : 0u;
            held += cascade.axis[k].held ? 1u : 0u;
            limited += cascade.axis[k].limit.at_max ? 1u : 0u;
        }
    }
    for (uint32_t k = 0u; k < AXES; k++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 8u, running[k]);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 8u, held);
    TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 8u, limited);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAS_004_every_step_is_the_specified_one);
    return UNITY_END();
}
