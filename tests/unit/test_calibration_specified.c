/* SPDX-License-Identifier: Apache-2.0 */
/* Calibrations beside their executable specification (specs/model): random and adversarial samples
 * to both, after each of which every bit must be the same, and within its bounds. */
#include "any.h"
#include "keel/flight/calibration.h"
#include "unity.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* The model is part of this test: the kernel that it is linked with has none. */
#include "../../specs/model/calibration.c"

#define STEPS       300000u
#define SETUP_EVERY 512u
#define SEED        20261124u

static keel_calibration_rest_t rest;
static keel_calibration_rest_t rest_model;
static keel_calibration_field_t field;
static keel_calibration_field_t field_model;

void setUp(void)
{
    any_from(SEED);
    memset(&rest, 0, sizeof rest);
    memset(&rest_model, 0, sizeof rest_model);
    memset(&field, 0, sizeof field);
    memset(&field_model, 0, sizeof field_model);
}

void tearDown(void)
{
}

/* What breaks arithmetic that did not expect it. */
static float awkward(void)
{
    const float values[] = {NAN,     INFINITY, -INFINITY, 0.0f,       -0.0f,      0x1p-149f,
                            FLT_MAX, -FLT_MAX, 32768.0f,  any_bits(), any_bits(), -32768.0f};

    return values[any() % (sizeof values / sizeof values[0])];
}

static float usually(float value)
{
    return one_in(128u) ? awkward() : value;
}

/* Mostly good ones: whether a configuration is taken is the model's to say, too. */
static void set_up_rest(void)
{
    const keel_calibration_rest_config_t config = {.expected = {usually(between(-1.0f, 1.0f)),
                                                                usually(between(-1.0f, 1.0f)),
                                                                usually(between(-10.0f, -9.0f))},
                                                   .spread = usually(between(0.05f, 1.0f)),
                                                   .limit = usually(between(0.0f, 2.0f)),
                                                   .samples = any() % 16u};
    const keel_status_t expected = model_calibration_rest_init(&rest_model, &config);

    TEST_ASSERT_EQUAL(expected, keel_calibration_rest_init(&rest, &config));
}

static void set_up_field(void)
{
    const keel_calibration_field_config_t config = {.lowest = usually(between(-500.0f, -60.0f)),
                                                    .highest = usually(between(60.0f, 500.0f)),
                                                    .span_min = usually(between(0.0f, 100.0f)),
                                                    .span_max = usually(between(80.0f, 150.0f)),
                                                    .limit = usually(between(0.0f, 60.0f))};
    const keel_status_t expected = model_calibration_field_init(&field_model, &config);

    TEST_ASSERT_EQUAL(expected, keel_calibration_field_init(&field, &config));
}

static void CAL_004_every_step_at_rest_is_the_specified_one(void)
{
    uint32_t seen[4] = {0u};

    for (uint32_t i = 0u; i < STEPS; i++) {
        const float wide = one_in(64u) ? 3.0f : 0.05f;
        const float sample[KEEL_CALIBRATION_AXES] = {usually(between(-wide, wide)),
                                                     usually(0.25f + between(-wide, wide)),
                                                     usually(-9.5f + between(-wide, wide))};

        if ((i % SETUP_EVERY) == 0u) {
            set_up_rest();
        }
        if (one_in(32u)) {
            keel_calibration_rest_begin(&rest);
            model_calibration_rest_begin(&rest_model);
        }
        keel_calibration_rest_step(&rest, sample);
        model_calibration_rest_step(&rest_model, sample);
        TEST_ASSERT_EQUAL_MEMORY(&rest_model, &rest, sizeof rest);
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            TEST_ASSERT_TRUE(fabsf(rest.offset[k]) <= rest.config.limit);
            TEST_ASSERT_TRUE(fabsf(rest.first[k]) <= 32768.0f);
            TEST_ASSERT_TRUE(fabsf(rest.sum[k]) <= (32768.0f * 65536.0f));
        }
        seen[rest.state]++;
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, seen[i]);
    }
}

static void CAL_010_every_step_of_a_turn_is_the_specified_one(void)
{
    uint32_t told[4] = {0u};
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < STEPS; i++) {
        const float wide = one_in(64u) ? 100.0f : 45.0f;
        const float sample[KEEL_CALIBRATION_AXES] = {usually(between(-wide, wide)),
                                                     usually(10.0f + between(-wide, wide)),
                                                     usually(-20.0f + between(-wide, wide))};
        const uint32_t axis = any() % KEEL_CALIBRATION_AXES;
        keel_calibration_verdict_t verdict;

        if ((i % SETUP_EVERY) == 0u) {
            set_up_field();
        }
        if (one_in(32u)) {
            keel_calibration_field_begin(&field);
            model_calibration_field_begin(&field_model);
        }
        keel_calibration_field_step(&field, sample);
        model_calibration_field_step(&field_model, sample);
        verdict = keel_calibration_field_axis(&field, axis);
        TEST_ASSERT_EQUAL(model_calibration_field_axis(&field_model, axis), verdict);
        told[verdict]++;
        if (one_in(16u)) {
            const keel_status_t expected = model_calibration_field_finish(&field_model);

            TEST_ASSERT_EQUAL(expected, keel_calibration_field_finish(&field));
            taken += (expected == KEEL_OK) ? 1u : 0u;
        }
        TEST_ASSERT_EQUAL_MEMORY(&field_model, &field, sizeof field);
        TEST_ASSERT_TRUE(fabsf(field.offset[axis]) <= field.config.limit);
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, told[i]);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 1000u, taken);
}

static void CAL_014_every_sample_is_the_specified_one(void)
{
    for (uint32_t i = 0u; i < STEPS; i++) {
        const float offset[KEEL_CALIBRATION_AXES] = {between(-2.0f, 2.0f), any_bits(), awkward()};
        const float raw[KEEL_CALIBRATION_AXES] = {between(-9.0f, 9.0f), any_bits(), awkward()};
        keel_calibration_vector_t out;
        keel_calibration_vector_t expected;

        keel_calibration_apply(offset, raw, &out);
        model_calibration_apply(offset, raw, &expected);
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            TEST_ASSERT_TRUE((isnan(out.axis[k]) && isnan(expected.axis[k])) ||
                             (out.axis[k] == expected.axis[k]));
        }
    }
}

static void any_three(float *three, float middle, float wide)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        three[k] = usually(middle + between(-wide, wide));
    }
}

static void CAL_015_every_correction_and_turn_is_the_specified_one(void)
{
    for (uint32_t i = 0u; i < STEPS; i++) {
        keel_calibration_correction_t correction;
        keel_calibration_rotation_t turn;
        keel_calibration_vector_t raw;
        keel_calibration_vector_t out;
        keel_calibration_vector_t model;

        any_three(correction.offset, 0.0f, 1.0f);
        any_three(correction.scale, 1.0f, 0.1f);
        any_three(raw.axis, 0.0f, 20.0f);
        any_three(turn.x, 0.0f, 1.0f);
        any_three(turn.y, 0.0f, 1.0f);
        any_three(turn.z, 0.0f, 1.0f);
        keel_calibration_turn(&turn, raw.axis, &out);
        model_calibration_turn(&turn, raw.axis, &model);
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            TEST_ASSERT_TRUE((isnan(model.axis[k]) && isnan(out.axis[k])) ||
                             (memcmp(&model.axis[k], &out.axis[k], sizeof(float)) == 0));
        }
        model_calibration_correct(&correction, raw.axis, &model);
        keel_calibration_correct(&correction, raw.axis, &raw);
        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            TEST_ASSERT_TRUE((isnan(model.axis[k]) && isnan(raw.axis[k])) ||
                             (memcmp(&model.axis[k], &raw.axis[k], sizeof(float)) == 0));
        }
    }
}

static void CAL_017_every_six_sides_are_the_specified_ones(void)
{
    uint32_t told[KEEL_CALIBRATION_SIDES + 1u] = {0u};
    uint32_t taken = 0u;

    for (uint32_t i = 0u; i < STEPS; i++) {
        keel_calibration_vector_t mean;
        keel_calibration_sides_t sides = {.gravity = usually(9.8f), .limit = usually(1.0f)};
        keel_calibration_correction_t correction;
        keel_calibration_correction_t model;
        keel_status_t status;
        uint32_t side;

        any_three(mean.axis, 0.0f, 1.5f);
        mean.axis[any() % 3u] = usually(between(6.0f, 11.0f) * (one_in(2u) ? 1.0f : -1.0f));
        side = keel_calibration_side(mean.axis, 7.35f, 1.225f);
        TEST_ASSERT_EQUAL_UINT32(model_calibration_side(mean.axis, 7.35f, 1.225f), side);
        told[side]++;
        any_three(sides.up, 9.8f, 1.2f);
        any_three(sides.down, -9.8f, 1.2f);
        any_three(correction.offset, 0.0f, 1.0f);
        any_three(correction.scale, 0.0f, 1.0f);
        model = correction;
        status = keel_calibration_six(&sides, &correction);
        TEST_ASSERT_EQUAL(model_calibration_six(&sides, &model), status);
        TEST_ASSERT_EQUAL_MEMORY(&model, &correction, sizeof correction);
        taken += (status == KEEL_OK) ? 1u : 0u;
    }
    for (uint32_t i = 0u; i <= KEEL_CALIBRATION_SIDES; i++) {
        TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, told[i]);
    }
    TEST_ASSERT_GREATER_THAN_UINT32(STEPS / 100u, taken);
    TEST_ASSERT_LESS_THAN_UINT32(STEPS - (STEPS / 100u), taken);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAL_004_every_step_at_rest_is_the_specified_one);
    RUN_TEST(CAL_010_every_step_of_a_turn_is_the_specified_one);
    RUN_TEST(CAL_014_every_sample_is_the_specified_one);
    RUN_TEST(CAL_015_every_correction_and_turn_is_the_specified_one);
    RUN_TEST(CAL_017_every_six_sides_are_the_specified_ones);
    return UNITY_END();
}
