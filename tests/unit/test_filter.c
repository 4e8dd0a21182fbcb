/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/flight/filter.h. Expected values are worked out by hand. */
#include "keel/flight/filter.h"
#include "unity.h"

#include <math.h>
#include <string.h>

/* A quarter of the rate: g = 1, so that
 *     H(z) = (1 + z^-1)^2 / (2 + sqrt(2) + (2 - sqrt(2)) z^-2). */
#define RATE_HZ   1000.0f
#define CUTOFF_HZ 250.0f

static keel_filter_t filter;

void setUp(void)
{
    memset(&filter, 0x55, sizeof filter);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, RATE_HZ, CUTOFF_HZ));
}

void tearDown(void)
{
}

static void init_refuses(keel_status_t status, float rate_hz, float cutoff_hz)
{
    keel_filter_t before;

    memcpy(&before, &filter, sizeof before);
    TEST_ASSERT_EQUAL(status, keel_filter_init(&filter, rate_hz, cutoff_hz));
    TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
}

static void FLT_001_bad_rates_are_refused(void)
{
    init_refuses(KEEL_ERR_RATE, 0.0f, 0.0f);
    init_refuses(KEEL_ERR_RATE, -1000.0f, 100.0f);
    init_refuses(KEEL_ERR_RATE, 0x1.fffffep-11f, 0.0001f);
    init_refuses(KEEL_ERR_RATE, 1000000.0625f, 100.0f);
    init_refuses(KEEL_ERR_RATE, INFINITY, 100.0f);
    init_refuses(KEEL_ERR_RATE, NAN, 100.0f);
}

static void FLT_001_bad_cutoffs_are_refused(void)
{
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, 500.0f);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, 2000.0f);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, 0.0f);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, -100.0f);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, INFINITY);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, -INFINITY);
    init_refuses(KEEL_ERR_CUTOFF, 1000.0f, NAN);
    /* 2^-20 of 2^10 Hz is 2^-10 Hz. */
    init_refuses(KEEL_ERR_CUTOFF, 1024.0f, 0x1.fffffep-11f);
}

static void FLT_001_all_between_is_taken(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 0x1p-10f, 0.0001f));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 1.0e6f, 1.0f));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 1024.0f, 0.0009765625f));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 1000.0f, 0x1.f3fffep+8f));
    TEST_ASSERT_TRUE(filter.a <= 1.0f);
    TEST_ASSERT_TRUE(filter.b > 0.0f);
    TEST_ASSERT_TRUE(filter.c >= -1.0f);
}

static void coefficients_are(float cutoff_hz, float a, float b, float c)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 1000.0f, cutoff_hz));
    TEST_ASSERT_FLOAT_WITHIN(5e-7f, a, filter.a);
    TEST_ASSERT_FLOAT_WITHIN(5e-7f, b, filter.b);
    TEST_ASSERT_FLOAT_WITHIN(5e-7f, c, filter.c);
}

static void FLT_002_coefficients(void)
{
    /* g = 1, D = 2 + sqrt(2). */
    coefficients_are(250.0f, 0.29289322f, 0.41421356f, -0.41421356f);
    /* g = sqrt(2) - 1, D = 6 - 3 sqrt(2). */
    coefficients_are(125.0f, 0.09763107f, 0.33333333f, 0.13807119f);
    /* g = sqrt(2) + 1, D = 6 + 3 sqrt(2). */
    coefficients_are(375.0f, 0.56903559f, 0.33333333f, -0.80473785f);
}

static void FLT_003_starts_at_rest(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.0f, filter.s1);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, filter.s2);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, filter.output);
    TEST_ASSERT_EQUAL_FLOAT(0x1p44f, filter.energy_limit);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_init(&filter, 1000.0f, 250.1f));
    TEST_ASSERT_EQUAL_FLOAT(0x1p90f, filter.energy_limit);
}

static void step_to(float expected, float input)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_step(&filter, input));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, expected, filter.output);
}

static void FLT_004_reset_is_rest_at_a_value(void)
{
    step_to(0.29289322f, 1.0f);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_reset(&filter, -7.25f));
    TEST_ASSERT_EQUAL_FLOAT(-7.25f, filter.output);
    for (int i = 0; i < 10; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_step(&filter, -7.25f));
        TEST_ASSERT_EQUAL_FLOAT(-7.25f, filter.output);
    }
}

static void FLT_004_reset_takes_what_a_step_takes(void)
{
    keel_filter_t before;
    const float bad[] = {NAN, INFINITY, -INFINITY, 1000001.0f, -1000001.0f};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_reset(&filter, 1.0e6f));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_reset(&filter, -1.0e6f));
    memcpy(&before, &filter, sizeof before);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_filter_reset(&filter, bad[i]));
        TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
    }
}

static void FLT_005_step_response(void)
{
    /* From the difference equation of H(z) above, each 2 + sqrt(2) times:
     * 1; 3; 4 - (2 - sqrt(2)) y0; 4 - (2 - sqrt(2)) y1. */
    step_to(0.29289322f, 1.0f);
    step_to(0.87867966f, 1.0f);
    step_to(1.12132034f, 1.0f);
    step_to(1.02081528f, 1.0f);
}

static void FLT_005_energy_stays_below_its_limit(void)
{
    keel_filter_t before;

    /* From s = (2^22, 0) the input 10^6 leads to s1 = c 2^22 + b 10^6 = -1.3 10^6 and to
     * s2 = 2 (b 2^22 + a 10^6) = 4.06 10^6: an energy of 1.82 10^13, above 2^44 = 1.76 10^13.
     * The input -10^6 leads to -2.15 10^6 and 2.89 10^6, which is 1.3 10^13. */
    filter.s1 = KEEL_FILTER_LOW_STATE_LIMIT;
    memcpy(&before, &filter, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_filter_step(&filter, 1.0e6f));
    TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_step(&filter, -1.0e6f));
    TEST_ASSERT_FLOAT_WITHIN(0.01e6f, 2.89e6f, filter.s2);
}

static void FLT_006_bad_inputs_are_held(void)
{
    keel_filter_t before;
    const float bad[] = {NAN, INFINITY, -INFINITY, 1000001.0f, -1000001.0f, 3.4e38f};

    step_to(0.29289322f, 1.0f);
    memcpy(&before, &filter, sizeof before);
    for (size_t i = 0u; i < (sizeof bad / sizeof bad[0]); i++) {
        TEST_ASSERT_EQUAL(KEEL_ERR_INPUT, keel_filter_step(&filter, bad[i]));
        TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
    }
    step_to(0.87867966f, 1.0f);
}

static void FLT_006_the_greatest_inputs_are_taken(void)
{
    for (int i = 0; i < 100; i++) {
        TEST_ASSERT_EQUAL(KEEL_OK, keel_filter_step(&filter, ((i % 7) < 3) ? 1.0e6f : -1.0e6f));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(FLT_001_bad_rates_are_refused);
    RUN_TEST(FLT_001_bad_cutoffs_are_refused);
    RUN_TEST(FLT_001_all_between_is_taken);
    RUN_TEST(FLT_002_coefficients);
    RUN_TEST(FLT_003_starts_at_rest);
    RUN_TEST(FLT_004_reset_is_rest_at_a_value);
    RUN_TEST(FLT_004_reset_takes_what_a_step_takes);
    RUN_TEST(FLT_005_step_response);
    RUN_TEST(FLT_005_energy_stays_below_its_limit);
    RUN_TEST(FLT_006_bad_inputs_are_held);
    RUN_TEST(FLT_006_the_greatest_inputs_are_taken);
    return UNITY_END();
}
