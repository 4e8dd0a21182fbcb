/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/calibration.h. Expected values are worked out by hand from the formulas
 * of calibration.h. */
#include "keel/flight/calibration.h"
#include "unity.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#define LIMIT 32768.0f

static keel_calibration_rest_config_t rest_config;
static keel_calibration_field_config_t field_config;
static keel_calibration_rest_t rest;
static keel_calibration_field_t field;

void setUp(void)
{
    const keel_calibration_rest_config_t level = {
        .expected = {0.0f, 0.0f, -9.5f}, .spread = 0.5f, .limit = 2.0f, .samples = 4u};
    const keel_calibration_field_config_t earth = {.lowest = -400.0f,
                                                   .highest = 500.0f,
                                                   .span_min = 64.0f,
                                                   .span_max = 128.0f,
                                                   .limit = 50.0f};

    rest_config = level;
    field_config = earth;
    memset(&rest, 0x55, sizeof rest);
    memset(&field, 0x55, sizeof field);
}

void tearDown(void)
{
}

static void make_rest(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_calibration_rest_init(&rest, &rest_config));
}

static void make_field(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_calibration_field_init(&field, &field_config));
}

static void begin_rest(void)
{
    make_rest();
    keel_calibration_rest_begin(&rest);
}

static void begin_field(void)
{
    make_field();
    keel_calibration_field_begin(&field);
}

static void at_rest(float x, float y, float z)
{
    const float sample[KEEL_CALIBRATION_AXES] = {x, y, z};

    keel_calibration_rest_step(&rest, sample);
}

static void turned(float x, float y, float z)
{
    const float sample[KEEL_CALIBRATION_AXES] = {x, y, z};

    keel_calibration_field_step(&field, sample);
}

static void are(const float *is, float x, float y, float z)
{
    TEST_ASSERT_EQUAL_FLOAT(x, is[0]);
    TEST_ASSERT_EQUAL_FLOAT(y, is[1]);
    TEST_ASSERT_EQUAL_FLOAT(z, is[2]);
}

static void rest_refuses(keel_status_t status)
{
    keel_calibration_rest_t before;

    memcpy(&before, &rest, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_calibration_rest_init(&rest, &rest_config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &rest, sizeof rest);
}

static void field_refuses(keel_status_t status)
{
    keel_calibration_field_t before;

    memcpy(&before, &field, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_calibration_field_init(&field, &field_config));
    TEST_ASSERT_EQUAL_MEMORY(&before, &field, sizeof field);
}

/* A number is taken from least to most, and nothing else is. */
static void has_range(float *value, float least, float most, void (*refuses)(keel_status_t),
                      keel_status_t status, void (*make)(void))
{
    const float good = *value;
    const float bad[] = {nextafterf(least, -INFINITY), nextafterf(most, INFINITY), NAN, INFINITY,
                         -INFINITY};

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        *value = bad[i];
        refuses(status);
    }
    *value = least;
    make();
    *value = most;
    make();
    *value = good;
}

static void CAL_001_bad_expectations_are_refused(void)
{
    for (size_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        has_range(&rest_config.expected[k], -LIMIT, LIMIT, rest_refuses, KEEL_ERR_VALUE, make_rest);
    }
}

static void CAL_001_bad_limits_are_refused(void)
{
    has_range(&rest_config.spread, 0.0f, LIMIT, rest_refuses, KEEL_ERR_LIMITS, make_rest);
    has_range(&rest_config.limit, 0.0f, LIMIT, rest_refuses, KEEL_ERR_LIMITS, make_rest);
}

static void CAL_001_bad_numbers_of_samples_are_refused(void)
{
    const uint32_t bad[] = {0u, 65537u, UINT32_MAX};

    for (size_t i = 0u; i < 3u; i++) {
        rest_config.samples = bad[i];
        rest_refuses(KEEL_ERR_LIMITS);
    }
    rest_config.samples = 65536u;
    make_rest();
}

static void CAL_001_the_first_reason_is_told(void)
{
    rest_config.samples = 0u;
    rest_config.expected[1] = NAN;
    rest_refuses(KEEL_ERR_VALUE);
}

static void CAL_002_made_as_configured(void)
{
    make_rest();
    TEST_ASSERT_EQUAL_MEMORY(&rest_config, &rest.config, sizeof rest_config);
    TEST_ASSERT_EQUAL_FLOAT(0.25f, rest.per_sample);
}

static void CAL_003_made_with_no_offset_and_idle(void)
{
    make_rest();
    are(rest.offset, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_IDLE, rest.state);
    at_rest(1.0f, 1.0f, -9.5f);
    TEST_ASSERT_EQUAL_UINT32(0u, rest.count);
}

/* The sums are exact: 0.25 + 0.5 - 0.25 = 0.5, an eighth of 4 samples. */
static void CAL_004_the_mean_of_a_run_is_the_offset(void)
{
    begin_rest();
    at_rest(1.0f, -1.0f, -10.0f);
    TEST_ASSERT_EQUAL_UINT32(1u, rest.count);
    are(rest.first, 1.0f, -1.0f, -10.0f);
    at_rest(1.25f, -1.25f, -10.0f);
    at_rest(1.5f, -1.5f, -9.5f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_COLLECTING, rest.state);
    are(rest.offset, 0.0f, 0.0f, 0.0f);
    at_rest(0.75f, -1.25f, -10.0f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_DONE, rest.state);
    are(rest.offset, 1.125f, -1.25f, -0.375f);
}

static void CAL_004_nothing_is_looked_at_when_done(void)
{
    keel_calibration_rest_t before;

    rest_config.samples = 1u;
    begin_rest();
    at_rest(0.5f, 0.25f, -9.0f);
    are(rest.offset, 0.5f, 0.25f, 0.5f);
    memcpy(&before, &rest, sizeof before);
    at_rest(1.5f, 0.25f, -9.0f);
    TEST_ASSERT_EQUAL_MEMORY(&before, &rest, sizeof rest);
}

/* In float, 65536 equal samples far from 0 have exactly their mean. */
static void CAL_004_a_large_mean_takes_no_digits(void)
{
    rest_config.samples = 65536u;
    rest_config.limit = LIMIT;
    begin_rest();
    for (uint32_t i = 0u; i < 65536u; i++) {
        at_rest(16777.215f, ((i % 2u) == 0u) ? 9000.0f : 9000.25f, 0.1f);
    }
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_DONE, rest.state);
    are(rest.offset, 16777.215f, 9000.125f, 0.1f + 9.5f);
}

/* One sample on each axis and side that is too far off: the next begins another run. */
static void CAL_005_motion_begins_another_run(void)
{
    const float away[6][3] = {{0.75f, 0.0f, -9.5f},  {-0.75f, 0.0f, -9.5f}, {0.0f, 0.75f, -9.5f},
                              {0.0f, -0.75f, -9.5f}, {0.0f, 0.0f, -8.75f},  {0.0f, 0.0f, -10.25f}};

    begin_rest();
    for (size_t i = 0u; i < 6u; i++) {
        at_rest(0.0f, 0.0f, -9.5f);
        at_rest(0.0f, 0.5f, -10.0f);
        at_rest(0.0f, -0.5f, -9.0f);
        TEST_ASSERT_EQUAL_UINT32(3u, rest.count);
        at_rest(away[i][0], away[i][1], away[i][2]);
        TEST_ASSERT_EQUAL_UINT32(0u, rest.count);
        TEST_ASSERT_EQUAL_UINT16(i + 1u, rest.restarts);
    }
    for (size_t i = 0u; i < 4u; i++) {
        at_rest(1.0f, 1.0f, -9.0f);
    }
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_DONE, rest.state);
    are(rest.offset, 1.0f, 1.0f, 0.5f);
}

static void CAL_005_no_number_belongs_to_no_run(void)
{
    const float none[] = {NAN, INFINITY, -INFINITY, 32769.0f, -32769.0f};

    begin_rest();
    for (size_t i = 0u; i < 5u; i++) {
        at_rest(0.0f, 0.0f, -9.5f);
        at_rest(0.0f, none[i], -9.5f);
        TEST_ASSERT_EQUAL_UINT32(0u, rest.count);
        at_rest(none[i], 0.0f, -9.5f);
        at_rest(0.0f, 0.0f, none[i]);
        TEST_ASSERT_EQUAL_UINT16(i + 1u, rest.restarts);
    }
}

static void CAL_005_the_count_of_runs_stays_at_its_end(void)
{
    begin_rest();
    for (uint32_t i = 0u; i < 65540u; i++) {
        at_rest(0.0f, 0.0f, -9.5f);
        at_rest(NAN, 0.0f, -9.5f);
    }
    TEST_ASSERT_EQUAL_UINT16(65535u, rest.restarts);
}

/* Beyond the limit of 2 on one axis: none is taken. */
static void CAL_007_all_axes_or_none(void)
{
    const float beyond[6][3] = {{2.25f, 1.0f, -9.5f}, {-2.25f, 1.0f, -9.5f},
                                {1.0f, 2.25f, -9.5f}, {1.0f, -2.25f, -9.5f},
                                {1.0f, 1.0f, -7.25f}, {1.0f, 1.0f, -11.75f}};

    rest_config.samples = 1u;
    begin_rest();
    at_rest(2.0f, -2.0f, -7.5f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_DONE, rest.state);
    for (size_t i = 0u; i < 6u; i++) {
        keel_calibration_rest_begin(&rest);
        TEST_ASSERT_EQUAL(KEEL_CALIBRATION_COLLECTING, rest.state);
        TEST_ASSERT_EQUAL_UINT16(0u, rest.beyond);
        at_rest(beyond[i][0], beyond[i][1], beyond[i][2]);
        TEST_ASSERT_EQUAL(KEEL_CALIBRATION_REFUSED, rest.state);
        TEST_ASSERT_EQUAL_UINT16(1u << (i / 2u), rest.beyond);
        are(rest.offset, 2.0f, -2.0f, 2.0f);
    }
}

static void CAL_007_every_axis_that_is_beyond_is_told(void)
{
    const float beyond[4][3] = {
        {5.0f, 0.0f, 0.0f}, {0.0f, 5.0f, 0.0f}, {0.0f, -5.0f, -20.0f}, {-5.0f, 5.0f, 20.0f}};
    const uint16_t axes[] = {5u, 6u, 6u, 7u};

    rest_config.samples = 1u;
    make_rest();
    for (size_t i = 0u; i < 4u; i++) {
        keel_calibration_rest_begin(&rest);
        at_rest(beyond[i][0], beyond[i][1], beyond[i][2]);
        TEST_ASSERT_EQUAL_UINT16(axes[i], rest.beyond);
        are(rest.offset, 0.0f, 0.0f, 0.0f);
    }
}

static void CAL_008_bad_ranges_are_refused(void)
{
    has_range(&field_config.highest, -400.0f, LIMIT, field_refuses, KEEL_ERR_VALUE, make_field);
    has_range(&field_config.lowest, -LIMIT, 500.0f, field_refuses, KEEL_ERR_VALUE, make_field);
}

static void CAL_008_bad_limits_are_refused(void)
{
    has_range(&field_config.span_min, 0x1p-149f, 128.0f, field_refuses, KEEL_ERR_LIMITS,
              make_field);
    has_range(&field_config.span_max, 64.0f, 2.0f * LIMIT, field_refuses, KEEL_ERR_LIMITS,
              make_field);
    has_range(&field_config.limit, 0.0f, LIMIT, field_refuses, KEEL_ERR_LIMITS, make_field);
}

static void CAL_009_made_with_no_offset_and_idle(void)
{
    make_field();
    TEST_ASSERT_EQUAL_MEMORY(&field_config, &field.config, sizeof field_config);
    are(field.offset, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_IDLE, field.state);
    turned(1.0f, 2.0f, 3.0f);
    are(field.lowest, 500.0f, 500.0f, 500.0f);
    are(field.highest, -400.0f, -400.0f, -400.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_calibration_field_finish(&field));
}

static void CAL_010_lowest_and_highest_are_kept(void)
{
    begin_field();
    turned(1.0f, -2.0f, 3.0f);
    are(field.lowest, 1.0f, -2.0f, 3.0f);
    are(field.highest, 1.0f, -2.0f, 3.0f);
    turned(-400.0f, 500.0f, 3.0f);
    turned(0.0f, 0.0f, 0.0f);
    are(field.lowest, -400.0f, -2.0f, 0.0f);
    are(field.highest, 1.0f, 500.0f, 3.0f);
}

static void CAL_010_what_cannot_be_is_dropped(void)
{
    const float none[] = {NAN, INFINITY, -INFINITY, 500.5f, -400.5f};

    begin_field();
    turned(0.0f, 0.0f, 0.0f);
    for (size_t i = 0u; i < 5u; i++) {
        turned(none[i], 1.0f, 1.0f);
        turned(1.0f, none[i], 1.0f);
        turned(1.0f, 1.0f, none[i]);
    }
    are(field.highest, 0.0f, 0.0f, 0.0f);
    are(field.lowest, 0.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_UINT16(15u, field.dropped);
    for (uint32_t i = 0u; i < 65536u; i++) {
        turned(NAN, 0.0f, 0.0f);
    }
    TEST_ASSERT_EQUAL_UINT16(65535u, field.dropped);
}

static void axis_is(float lowest, float highest, keel_calibration_verdict_t verdict)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        begin_field();
        turned(-40.0f, -40.0f, -40.0f);
        turned(40.0f, 40.0f, 40.0f);
        field.lowest[k] = lowest;
        field.highest[k] = highest;
        TEST_ASSERT_EQUAL(verdict, keel_calibration_field_axis(&field, k));
        TEST_ASSERT_EQUAL(KEEL_CALIBRATION_FIT,
                          keel_calibration_field_axis(&field, (k + 1u) % KEEL_CALIBRATION_AXES));
        TEST_ASSERT_EQUAL((verdict == KEEL_CALIBRATION_FIT) ? KEEL_OK : KEEL_ERR_LIMITS,
                          keel_calibration_field_finish(&field));
        TEST_ASSERT_EQUAL_FLOAT((verdict == KEEL_CALIBRATION_FIT) ? ((lowest + highest) / 2.0f)
                                                                  : 0.0f,
                                field.offset[k]);
    }
}

static void CAL_011_what_is_turned_and_believed_fits(void)
{
    axis_is(-32.0f, 32.0f, KEEL_CALIBRATION_FIT);
    axis_is(-64.0f, 64.0f, KEEL_CALIBRATION_FIT);
    axis_is(0.0f, 100.0f, KEEL_CALIBRATION_FIT);
    axis_is(-100.0f, 0.0f, KEEL_CALIBRATION_FIT);
}

static void CAL_011_an_axis_that_does_not_fit_says_why(void)
{
    axis_is(-32.0f, 31.75f, KEEL_CALIBRATION_NARROW);
    axis_is(-64.0f, 64.25f, KEEL_CALIBRATION_WIDE);
    axis_is(-300.0f, 300.0f, KEEL_CALIBRATION_WIDE);
    axis_is(0.25f, 100.0f, KEEL_CALIBRATION_BEYOND);
    axis_is(-100.0f, -0.25f, KEEL_CALIBRATION_BEYOND);
    axis_is(300.0f, 310.0f, KEEL_CALIBRATION_NARROW);
}

static void CAL_011_nothing_seen_is_not_enough(void)
{
    begin_field();
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        TEST_ASSERT_EQUAL(KEEL_CALIBRATION_NARROW, keel_calibration_field_axis(&field, k));
    }
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_calibration_field_finish(&field));
}

static void CAL_012_a_refusal_changes_nothing(void)
{
    keel_calibration_field_t before;

    begin_field();
    turned(-40.0f, -30.0f, -80.0f);
    turned(40.0f, 60.0f, -40.0f);
    memcpy(&before, &field, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_LIMITS, keel_calibration_field_finish(&field));
    TEST_ASSERT_EQUAL_MEMORY(&before, &field, sizeof field);
    turned(0.0f, 0.0f, 20.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_calibration_field_finish(&field));
    are(field.offset, 0.0f, 15.0f, -30.0f);
    TEST_ASSERT_EQUAL(KEEL_CALIBRATION_DONE, field.state);
    turned(100.0f, 100.0f, 100.0f);
    are(field.highest, 40.0f, 60.0f, 20.0f);
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_calibration_field_finish(&field));
    keel_calibration_field_begin(&field);
    are(field.offset, 0.0f, 15.0f, -30.0f);
    are(field.lowest, 500.0f, 500.0f, 500.0f);
}

static void CAL_014_the_offset_is_taken_off(void)
{
    const float offset[KEEL_CALIBRATION_AXES] = {1.0f, -2.0f, 0.5f};
    keel_calibration_vector_t sample = {{10.0f, 20.0f, 30.0f}};
    keel_calibration_vector_t out;

    keel_calibration_apply(offset, sample.axis, &out);
    are(out.axis, 9.0f, 22.0f, 29.5f);
    are(sample.axis, 10.0f, 20.0f, 30.0f);
    keel_calibration_apply(offset, sample.axis, &sample);
    are(sample.axis, 9.0f, 22.0f, 29.5f);
    sample.axis[1] = NAN;
    keel_calibration_apply(offset, sample.axis, &sample);
    TEST_ASSERT_TRUE(isnan(sample.axis[1]));
}

static void CAL_015_a_sample_is_corrected_in_its_own_place_too(void)
{
    const keel_calibration_correction_t correction = {.offset = {1.0f, -2.0f, 0.5f},
                                                      .scale = {1.0f, 1.125f, 0.875f}};
    const float raw[KEEL_CALIBRATION_AXES] = {3.0f, 6.0f, 2.5f};
    keel_calibration_vector_t out = {{3.0f, 6.0f, NAN}};

    keel_calibration_correct(&correction, out.axis, &out);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, out.axis[0]);
    TEST_ASSERT_EQUAL_FLOAT(9.0f, out.axis[1]);
    TEST_ASSERT_TRUE(isnan(out.axis[2]));
    keel_calibration_correct(&correction, raw, &out);
    are(out.axis, 2.0f, 9.0f, 1.75f);
}

static uint32_t side(float x, float y, float z)
{
    const float mean[KEEL_CALIBRATION_AXES] = {x, y, z};

    /* Three quarters of gravity, and an eighth. */
    return keel_calibration_side(mean, 7.355f, 1.2258f);
}

static void CAL_016_each_side_is_told(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, side(9.8f, 0.0f, 0.0f)); /* Its nose points up. */
    TEST_ASSERT_EQUAL_UINT32(1u, side(-9.8f, 0.0f, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(2u, side(0.0f, 9.8f, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(3u, side(0.0f, -9.8f, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(4u, side(0.0f, 0.0f, 9.8f));
    TEST_ASSERT_EQUAL_UINT32(5u, side(0.0f, 0.0f, -9.8f)); /* It stands. */
}

static void CAL_016_what_leans_has_no_side(void)
{
    /* The sine of 7 degrees is 0.1219, of 8 degrees 0.1392; an eighth is 0.125. */
    TEST_ASSERT_EQUAL_UINT32(5u, side(1.195f, -1.195f, -9.7f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(1.365f, 0.0f, -9.7f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(0.0f, -1.365f, -9.7f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(0.0f, 0.0f, -7.35f)); /* Three quarters are 7.355. */
    TEST_ASSERT_EQUAL_UINT32(6u, side(0.0f, 7.35f, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(0.0f, 0.0f, 0.0f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(NAN, 0.0f, -9.8f));
    TEST_ASSERT_EQUAL_UINT32(6u, side(0.0f, 0.0f, NAN));
    TEST_ASSERT_EQUAL_UINT32(6u, side(-INFINITY, 0.0f, 0.0f));
}

/* Each axis with each of these, and the others with each of those: a side only where one axis alone
 * has most of gravity. */
static void CAL_016_every_combination(void)
{
    const float own[] = {7.36f, 9.8f, LIMIT, 7.35f, 0.0f, 2.0f * LIMIT, INFINITY, NAN};
    const float other[] = {0.0f, 1.2f, -1.2f, 1.3f, -1.3f, 9.8f, -9.8f, INFINITY, NAN};
    const size_t fits = 3u;   /* Of own. */
    const size_t little = 3u; /* Of other. */

    for (size_t i = 0u; i < (2u * (sizeof own / sizeof own[0])); i++) {
        for (size_t j = 0u; j < (sizeof other / sizeof other[0]); j++) {
            for (size_t m = 0u; m < (sizeof other / sizeof other[0]); m++) {
                for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
                    const bool is_down = (i % 2u) != 0u;
                    const bool is_side = ((i / 2u) < fits) && (j < little) && (m < little);
                    float mean[KEEL_CALIBRATION_AXES];

                    mean[k] = is_down ? -own[i / 2u] : own[i / 2u];
                    mean[(k + 1u) % 3u] = other[j];
                    mean[(k + 2u) % 3u] = other[m];
                    if (is_side) {
                        TEST_ASSERT_EQUAL_UINT32((2u * k) + (is_down ? 1u : 0u),
                                                 keel_calibration_side(mean, 7.355f, 1.2258f));
                    } else if ((j < 5u) && (m < 5u)) {
                        TEST_ASSERT_EQUAL_UINT32(6u, keel_calibration_side(mean, 7.355f, 1.2258f));
                    } else {
                        /* Another axis may be the one; it has its own turn. */
                        (void)keel_calibration_side(mean, 7.355f, 1.2258f);
                    }
                }
            }
        }
    }
}

/* The first axis of which the others have at most so much, and itself at least so much. */
static uint32_t first_side(const float mean[KEEL_CALIBRATION_AXES], float least, float most)
{
    for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        const float says = mean[k];

        if ((fabsf(mean[(k + 1u) % 3u]) <= most) && (fabsf(mean[(k + 2u) % 3u]) <= most)) {
            if ((says >= least) && (says <= LIMIT)) {
                return 2u * k;
            }
            if ((says <= -least) && (says >= -LIMIT)) {
                return (2u * k) + 1u;
            }
        }
    }
    return 6u;
}

/* With thresholds that more than one axis can meet the first of them is told. */
static void CAL_016_the_first_of_several(void)
{
    const float says[] = {5.0f,         -5.0f,         0.5f,         -0.5f,         20.0f, -20.0f,
                          2.0f * LIMIT, -2.0f * LIMIT, 8.0f * LIMIT, -8.0f * LIMIT, NAN};
    const float threshold[][2] = {
        {1.0f, 9.0f}, {1.0f, 4.0f * LIMIT}, {-1.0f, 9.0f}, {9.0f, 1.0f}, {-16.0f * LIMIT, 9.0f}};
    const size_t count = sizeof says / sizeof says[0];

    for (size_t t = 0u; t < (sizeof threshold / sizeof threshold[0]); t++) {
        for (size_t i = 0u; i < (count * count * count); i++) {
            const float mean[KEEL_CALIBRATION_AXES] = {says[i % count], says[(i / count) % count],
                                                       says[i / (count * count)]};

            TEST_ASSERT_EQUAL_UINT32(first_side(mean, threshold[t][0], threshold[t][1]),
                                     keel_calibration_side(mean, threshold[t][0], threshold[t][1]));
        }
    }
}

/* The offsets are 0.25, -0.5, 0.5; the spans 19, 20, 18. */
static keel_calibration_sides_t six_sides(void)
{
    const keel_calibration_sides_t sides = {
        .up = {9.75f, 9.5f, 9.5f}, .down = {-9.25f, -10.5f, -8.5f}, .gravity = 9.5f, .limit = 0.5f};

    return sides;
}

static void six_refuses(const keel_calibration_sides_t *sides, keel_status_t status)
{
    keel_calibration_correction_t correction;
    keel_calibration_correction_t before;

    memset(&correction, 0x55, sizeof correction);
    memcpy(&before, &correction, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_calibration_six(sides, &correction));
    TEST_ASSERT_EQUAL_MEMORY(&before, &correction, sizeof correction);
}

static void CAL_017_six_sides_are_offset_and_scale(void)
{
    const keel_calibration_sides_t sides = six_sides();
    keel_calibration_correction_t correction;
    keel_calibration_vector_t out;

    TEST_ASSERT_EQUAL(KEEL_OK, keel_calibration_six(&sides, &correction));
    are(correction.offset, 0.25f, -0.5f, 0.5f);
    are(correction.scale, 1.0f, 0.95f, 19.0f / 18.0f);
    keel_calibration_correct(&correction, sides.up, &out);
    for (size_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, 9.5f, out.axis[k]);
    }
}

static void CAL_017_a_bad_gravity_or_limit_is_refused(void)
{
    const float bad[] = {-1.0f, NAN, INFINITY, nextafterf(LIMIT, INFINITY)};
    keel_calibration_sides_t sides = six_sides();

    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        sides.gravity = bad[i];
        six_refuses(&sides, KEEL_ERR_VALUE);
        sides = six_sides();
        sides.limit = bad[i];
        six_refuses(&sides, KEEL_ERR_VALUE);
        sides = six_sides();
    }
    sides.gravity = 0.0f;
    six_refuses(&sides, KEEL_ERR_VALUE);
}

/* All three axes or none: each is spoilt in turn. */
static void CAL_017_what_cannot_be_believed_is_refused(void)
{
    const float up[] = {10.5f, NAN,  INFINITY, 2.0f * LIMIT, -9.0f, 8.4f,
                        10.9f, 9.5f, 9.5f,     9.5f,         0.1f};
    const float down[] = {-8.5f - 1e-3f, -9.5f,         -9.5f,        -2.0f * LIMIT, -9.0f, -8.4f,
                          -10.9f,        -2.0f * LIMIT, 2.0f * LIMIT, NAN,           -0.1f};

    for (size_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
        for (size_t i = 0u; i < (sizeof up / sizeof up[0]); i++) {
            keel_calibration_sides_t sides = six_sides();

            sides.up[k] = up[i];
            sides.down[k] = down[i];
            six_refuses(&sides, KEEL_ERR_LIMITS);
        }
    }
}

/* Sides that say about the same, on one axis or more. */
static void CAL_017_sides_that_are_alike_are_refused(void)
{
    for (uint32_t axes = 1u; axes < 8u; axes++) {
        keel_calibration_sides_t sides = six_sides();

        for (uint32_t k = 0u; k < KEEL_CALIBRATION_AXES; k++) {
            if (((axes >> k) & 1u) != 0u) {
                sides.up[k] = 0.1f;
                sides.down[k] = -0.1f;
            }
        }
        six_refuses(&sides, KEEL_ERR_LIMITS);
    }
}

/* A sensor that is mounted turned by 90 degrees to the right: its x is the vehicle's y. */
static void CAL_018_a_sample_is_turned(void)
{
    const keel_calibration_rotation_t right = {
        .x = {0.0f, -1.0f, 0.0f}, .y = {1.0f, 0.0f, 0.0f}, .z = {0.0f, 0.0f, 1.0f}};
    const keel_calibration_rotation_t any = {
        .x = {1.0f, 2.0f, 3.0f}, .y = {-4.0f, 5.0f, -6.0f}, .z = {7.0f, -8.0f, 9.0f}};
    const float raw[KEEL_CALIBRATION_AXES] = {1.0f, 2.0f, 4.0f};
    keel_calibration_vector_t out;

    keel_calibration_turn(&right, raw, &out);
    are(out.axis, -2.0f, 1.0f, 4.0f);
    keel_calibration_turn(&any, raw, &out);
    are(out.axis, 17.0f, -18.0f, 27.0f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(CAL_001_bad_expectations_are_refused);
    RUN_TEST(CAL_001_bad_limits_are_refused);
    RUN_TEST(CAL_001_bad_numbers_of_samples_are_refused);
    RUN_TEST(CAL_001_the_first_reason_is_told);
    RUN_TEST(CAL_002_made_as_configured);
    RUN_TEST(CAL_003_made_with_no_offset_and_idle);
    RUN_TEST(CAL_004_the_mean_of_a_run_is_the_offset);
    RUN_TEST(CAL_004_nothing_is_looked_at_when_done);
    RUN_TEST(CAL_004_a_large_mean_takes_no_digits);
    RUN_TEST(CAL_005_motion_begins_another_run);
    RUN_TEST(CAL_005_no_number_belongs_to_no_run);
    RUN_TEST(CAL_005_the_count_of_runs_stays_at_its_end);
    RUN_TEST(CAL_007_all_axes_or_none);
    RUN_TEST(CAL_007_every_axis_that_is_beyond_is_told);
    RUN_TEST(CAL_008_bad_ranges_are_refused);
    RUN_TEST(CAL_008_bad_limits_are_refused);
    RUN_TEST(CAL_009_made_with_no_offset_and_idle);
    RUN_TEST(CAL_010_lowest_and_highest_are_kept);
    RUN_TEST(CAL_010_what_cannot_be_is_dropped);
    RUN_TEST(CAL_011_what_is_turned_and_believed_fits);
    RUN_TEST(CAL_011_an_axis_that_does_not_fit_says_why);
    RUN_TEST(CAL_011_nothing_seen_is_not_enough);
    RUN_TEST(CAL_012_a_refusal_changes_nothing);
    RUN_TEST(CAL_014_the_offset_is_taken_off);
    RUN_TEST(CAL_015_a_sample_is_corrected_in_its_own_place_too);
    RUN_TEST(CAL_016_each_side_is_told);
    RUN_TEST(CAL_016_what_leans_has_no_side);
    RUN_TEST(CAL_016_every_combination);
    RUN_TEST(CAL_016_the_first_of_several);
    RUN_TEST(CAL_017_sides_that_are_alike_are_refused);
    RUN_TEST(CAL_017_six_sides_are_offset_and_scale);
    RUN_TEST(CAL_017_a_bad_gravity_or_limit_is_refused);
    RUN_TEST(CAL_017_what_cannot_be_believed_is_refused);
    RUN_TEST(CAL_018_a_sample_is_turned);
    return UNITY_END();
}
