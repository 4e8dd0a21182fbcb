/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/priority.h. Expected values are eq. 3, worked out by hand. */
#include "keel/rtos/priority.h"
#include "unity.h"

#define LONGEST_US 0x7FFFFFFFu /* The longest period. */

void setUp(void)
{
}

void tearDown(void)
{
}

static void PRI_001_is_one_plus_sp_at_the_release(void)
{
    /* A release is one period after the release before it. */
    TEST_ASSERT_EQUAL_UINT32(2u, keel_priority_dynamic(KEEL_PRIORITY_LOW, 1000u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(3u, keel_priority_dynamic(KEEL_PRIORITY_MEDIUM, 1000u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(4u, keel_priority_dynamic(KEEL_PRIORITY_MEDIUM_HIGH, 1000u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(5u, keel_priority_dynamic(KEEL_PRIORITY_HIGH, 1000u, 1000u));
}

static void PRI_001_rounds_down(void)
{
    TEST_ASSERT_EQUAL_UINT32(1u, keel_priority_dynamic(4u, 0u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_priority_dynamic(4u, 249u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_priority_dynamic(4u, 250u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(4u, keel_priority_dynamic(4u, 999u, 1000u));
    /* 3 * 16 = 48 and 3 * 17 = 51 over 7: 6.86 and 7.29. */
    TEST_ASSERT_EQUAL_UINT32(7u, keel_priority_dynamic(3u, 16u, 7u));
    TEST_ASSERT_EQUAL_UINT32(8u, keel_priority_dynamic(3u, 17u, 7u));
}

static void PRI_001_with_the_longest_period(void)
{
    TEST_ASSERT_EQUAL_UINT32(5u, keel_priority_dynamic(4u, LONGEST_US, LONGEST_US));
    /* 15 * (2^31 - 1) = 32212254705: at one less, eq. 3 is 15.99... */
    TEST_ASSERT_EQUAL_UINT32(15u, keel_priority_dynamic(1u, 32212254704u, LONGEST_US));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(1u, 32212254705u, LONGEST_US));
}

static void PRI_001_with_the_shortest_period(void)
{
    TEST_ASSERT_EQUAL_UINT32(1u, keel_priority_dynamic(1u, 0u, 1u));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_priority_dynamic(1u, 1u, 1u));
    TEST_ASSERT_EQUAL_UINT32(15u, keel_priority_dynamic(1u, 14u, 1u));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(1u, 15u, 1u));
}

static void PRI_002_saturates_at_every_age(void)
{
    /* 4 * 2^62 is 0 in 64 bits: the product must not be relied upon. */
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(4u, 0x4000000000000000u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(16u, 0x1000000000000000u, LONGEST_US));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(1u, UINT64_MAX, 1u));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(3u, UINT64_MAX, LONGEST_US));
}

static void PRI_003_never_falls_while_waiting(void)
{
    for (uint32_t sp = 1u; sp <= KEEL_PRIORITY_REALTIME; sp++) {
        uint32_t last = 1u;

        for (uint64_t age_us = 0u; age_us <= 600u; age_us++) {
            const uint32_t now = keel_priority_dynamic(sp, age_us, 37u);

            TEST_ASSERT_TRUE((now == last) || (now == (last + 1u)));
            last = now;
        }
        TEST_ASSERT_EQUAL_UINT32(16u, last);
    }
}

/* Promoted from this age on and not one microsecond before; dp and the age agree. */
static void promoted_from(uint64_t age_us, uint32_t sp, uint32_t period_us)
{
    TEST_ASSERT_FALSE(keel_priority_promoted(sp, age_us - 1u, period_us));
    TEST_ASSERT_TRUE(keel_priority_promoted(sp, age_us, period_us));
    TEST_ASSERT_EQUAL_UINT32(15u, keel_priority_dynamic(sp, age_us - 1u, period_us));
    TEST_ASSERT_EQUAL_UINT32(16u, keel_priority_dynamic(sp, age_us, period_us));
    TEST_ASSERT_EQUAL_UINT64(age_us, keel_priority_promotion_age_us(sp, period_us));
}

static void PRI_004_low_is_promoted_at_15_periods(void)
{
    promoted_from(15000u, KEEL_PRIORITY_LOW, 1000u);
}

static void PRI_004_medium_is_promoted_at_7_5_periods(void)
{
    promoted_from(7500u, KEEL_PRIORITY_MEDIUM, 1000u);
}

static void PRI_004_medium_high_is_promoted_at_5_periods(void)
{
    promoted_from(5000u, KEEL_PRIORITY_MEDIUM_HIGH, 1000u);
}

static void PRI_004_high_is_promoted_at_3_75_periods(void)
{
    promoted_from(3750u, KEEL_PRIORITY_HIGH, 1000u);
}

static void PRI_004_promotion_age_rounds_up(void)
{
    /* 15 * 7 / 4 = 26.25 and 15 * 7 / 2 = 52.5; 15 * (2^31 - 1) / 4 = 8053063676.25. */
    promoted_from(27u, 4u, 7u);
    promoted_from(53u, 2u, 7u);
    promoted_from(35u, 3u, 7u);
    promoted_from(8053063677u, 4u, LONGEST_US);
    promoted_from(32212254705u, 1u, LONGEST_US);
}

static void PRI_004_promoted_at_every_later_age(void)
{
    TEST_ASSERT_TRUE(keel_priority_promoted(4u, 0x4000000000000000u, 1000u));
    TEST_ASSERT_TRUE(keel_priority_promoted(4u, UINT64_MAX, LONGEST_US));
    TEST_ASSERT_FALSE(keel_priority_promoted(4u, 0u, 1u));
}

static void PRI_005_only_realtime_is_promoted_before_its_release(void)
{
    TEST_ASSERT_FALSE(keel_priority_promoted(KEEL_PRIORITY_HIGH, 1000u, 1000u));
    TEST_ASSERT_FALSE(keel_priority_promoted(14u, 1000u, 1000u));
    TEST_ASSERT_TRUE(keel_priority_promoted(KEEL_PRIORITY_REALTIME, 1000u, 1000u));
    /* 15 * 1000 / 16 = 937.5 */
    promoted_from(938u, KEEL_PRIORITY_REALTIME, 1000u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(PRI_001_is_one_plus_sp_at_the_release);
    RUN_TEST(PRI_001_rounds_down);
    RUN_TEST(PRI_001_with_the_longest_period);
    RUN_TEST(PRI_001_with_the_shortest_period);
    RUN_TEST(PRI_002_saturates_at_every_age);
    RUN_TEST(PRI_003_never_falls_while_waiting);
    RUN_TEST(PRI_004_low_is_promoted_at_15_periods);
    RUN_TEST(PRI_004_medium_is_promoted_at_7_5_periods);
    RUN_TEST(PRI_004_medium_high_is_promoted_at_5_periods);
    RUN_TEST(PRI_004_high_is_promoted_at_3_75_periods);
    RUN_TEST(PRI_004_promotion_age_rounds_up);
    RUN_TEST(PRI_004_promoted_at_every_later_age);
    RUN_TEST(PRI_005_only_realtime_is_promoted_before_its_release);
    return UNITY_END();
}
