/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/deviation.h. Expected values are worked out by hand. */
#include "keel/rtos/deviation.h"
#include "unity.h"

#include <string.h>

static keel_deviation_t deviation;

void setUp(void)
{
    memset(&deviation, 0, sizeof deviation);
}

void tearDown(void)
{
}

static void DEV_001_first_start_ends_no_period(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 123456u, 1000u));
    TEST_ASSERT_EQUAL_UINT64(0u, deviation.sum_us2);
    TEST_ASSERT_EQUAL_UINT64(123456u, deviation.start_us);
    TEST_ASSERT_EQUAL_UINT32(1u, deviation.starts);
}

static void DEV_001_late_and_early_starts_add_their_squares(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 0u, 1000u));
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1010u, 1000u)); /* 10 late */
    TEST_ASSERT_EQUAL_UINT64(100u, deviation.sum_us2);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1990u, 1000u)); /* 20 early */
    TEST_ASSERT_EQUAL_UINT64(500u, deviation.sum_us2);
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 2990u, 1000u)); /* on time */
    TEST_ASSERT_EQUAL_UINT64(500u, deviation.sum_us2);
    TEST_ASSERT_EQUAL_UINT64(2990u, deviation.start_us);
    TEST_ASSERT_EQUAL_UINT32(4u, deviation.starts);
}

static void DEV_001_farthest_sample_is_taken(void)
{
    deviation.starts = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1000u + 0xFFFFFFFFull, 1000u));
    TEST_ASSERT_EQUAL_UINT64(18446744065119617025ull, deviation.sum_us2);
}

static void DEV_001_sum_may_reach_its_limit(void)
{
    deviation.starts = 1u;
    deviation.sum_us2 = UINT64_MAX - 100u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1010u, 1000u));
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, deviation.sum_us2);
}

static void refuses(uint64_t start_us)
{
    keel_deviation_t before;

    memcpy(&before, &deviation, sizeof before);
    TEST_ASSERT_EQUAL(KEEL_ERR_STATE, keel_deviation_add(&deviation, start_us, 1000u));
    TEST_ASSERT_EQUAL_MEMORY(&before, &deviation, sizeof deviation);
}

static void DEV_002_full_count_is_refused(void)
{
    deviation.starts = UINT32_MAX;
    deviation.start_us = 500u;
    refuses(1500u);
    deviation.starts = UINT32_MAX - 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1500u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, deviation.starts);
}

static void DEV_002_farther_sample_is_refused(void)
{
    deviation.starts = 1u;
    refuses(1000u + 0x100000000ull);
    refuses(UINT64_MAX);
}

static void DEV_002_overflow_of_the_sum_is_refused(void)
{
    deviation.starts = 1u;
    deviation.sum_us2 = UINT64_MAX - 99u;
    refuses(1010u);
    refuses(990u);
}

static void DEV_003_variance_is_the_mean_square(void)
{
    TEST_ASSERT_EQUAL_UINT64(0u, keel_deviation_variance_us2(&deviation));
    deviation.starts = 1u;
    deviation.sum_us2 = 501u; /* No period has ended yet. */
    TEST_ASSERT_EQUAL_UINT64(0u, keel_deviation_variance_us2(&deviation));
    deviation.starts = 2u;
    TEST_ASSERT_EQUAL_UINT64(501u, keel_deviation_variance_us2(&deviation));
    deviation.starts = 3u;
    TEST_ASSERT_EQUAL_UINT64(250u, keel_deviation_variance_us2(&deviation));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(DEV_001_first_start_ends_no_period);
    RUN_TEST(DEV_001_late_and_early_starts_add_their_squares);
    RUN_TEST(DEV_001_farthest_sample_is_taken);
    RUN_TEST(DEV_001_sum_may_reach_its_limit);
    RUN_TEST(DEV_002_full_count_is_refused);
    RUN_TEST(DEV_002_farther_sample_is_refused);
    RUN_TEST(DEV_002_overflow_of_the_sum_is_refused);
    RUN_TEST(DEV_003_variance_is_the_mean_square);
    return UNITY_END();
}
