/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of app/limiter.h. */
#include "app/limiter.h"
#include "unity.h"

static limiter_t limiter;

void setUp(void)
{
    limiter_init(&limiter, 10u);
}

void tearDown(void)
{
}

static void LIM_001_begins_with_a_count_of_0(void)
{
    TEST_ASSERT_EQUAL(10u, limiter.limit);
    TEST_ASSERT_EQUAL(0u, limiter.count);
}

static void LIM_002_the_limit_itself_passes(void)
{
    TEST_ASSERT_EQUAL(10u, limiter_step(&limiter, 10u));
    TEST_ASSERT_EQUAL(0u, limiter.count);
}

static void LIM_002_what_is_too_large_is_limited_and_counted(void)
{
    TEST_ASSERT_EQUAL(10u, limiter_step(&limiter, 11u));
    TEST_ASSERT_EQUAL(1u, limiter.count);
}

static void LIM_002_the_count_ends_at_1000(void)
{
    for (uint32_t i = 0u; i < 1001u; i++) {
        (void)limiter_step(&limiter, 65535u);
    }
    TEST_ASSERT_EQUAL(1000u, limiter.count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(LIM_001_begins_with_a_count_of_0);
    RUN_TEST(LIM_002_the_limit_itself_passes);
    RUN_TEST(LIM_002_what_is_too_large_is_limited_and_counted);
    RUN_TEST(LIM_002_the_count_ends_at_1000);
    return UNITY_END();
}
