/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/rtos/stats.h. Expected values are worked out by hand. */
#include "keel/internal/rtos/stats.h"
#include "unity.h"

#include <string.h>

static keel_stats_t stats;

void setUp(void)
{
    memset(&stats, 0, sizeof stats);
}

void tearDown(void)
{
}

static void STS_001_last_and_longest_run(void)
{
    keel_stats_record(&stats, 30u, 100u);
    TEST_ASSERT_EQUAL_UINT32(30u, stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(30u, stats.longest_us);
    keel_stats_record(&stats, 70u, 100u);
    TEST_ASSERT_EQUAL_UINT32(70u, stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(70u, stats.longest_us);
    keel_stats_record(&stats, 50u, 100u);
    TEST_ASSERT_EQUAL_UINT32(50u, stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(70u, stats.longest_us);
}

static void STS_002_only_a_longer_run_overruns(void)
{
    keel_stats_record(&stats, 99u, 100u);
    keel_stats_record(&stats, 100u, 100u);
    TEST_ASSERT_EQUAL_UINT16(0u, stats.overruns);
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(1u, stats.overruns);
    keel_stats_record(&stats, UINT32_MAX, 100u);
    TEST_ASSERT_EQUAL_UINT16(2u, stats.overruns);
}

static void STS_002_overruns_stop_at_their_limit(void)
{
    stats.overruns = UINT16_MAX - 1u;
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.overruns);
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.overruns);
    TEST_ASSERT_EQUAL_UINT32(2u, stats.runs);
}

static void STS_003_runs_and_their_sum(void)
{
    keel_stats_record(&stats, 30u, 100u);
    keel_stats_record(&stats, 0u, 100u);
    keel_stats_record(&stats, 200u, 100u);
    TEST_ASSERT_EQUAL_UINT32(3u, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(230u, stats.total_us);
}

static void STS_003_mean_freezes_when_runs_are_full(void)
{
    stats.runs = UINT32_MAX - 1u;
    stats.total_us = 1000u;
    keel_stats_record(&stats, 5u, 100u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(1005u, stats.total_us);
    keel_stats_record(&stats, 6u, 100u);
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(1005u, stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(6u, stats.last_us);
}

static void STS_003_mean_freezes_when_the_sum_is_full(void)
{
    stats.runs = 9u;
    stats.total_us = UINT64_MAX - 10u;
    keel_stats_record(&stats, 10u, 100u);
    TEST_ASSERT_EQUAL_UINT32(10u, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, stats.total_us);
    keel_stats_record(&stats, 1u, 100u);
    TEST_ASSERT_EQUAL_UINT32(10u, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, stats.total_us);
}

static void STS_004_promotions_stop_at_their_limit(void)
{
    keel_stats_promote(&stats);
    TEST_ASSERT_EQUAL_UINT16(1u, stats.promotions);
    stats.promotions = UINT16_MAX - 1u;
    keel_stats_promote(&stats);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.promotions);
    keel_stats_promote(&stats);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.promotions);
    TEST_ASSERT_EQUAL_UINT32(0u, stats.runs);
}

static void STS_005_mean_rounds_down(void)
{
    TEST_ASSERT_EQUAL_UINT64(0u, keel_stats_mean_us(&stats));
    stats.total_us = 1000u; /* Not a run yet: still no mean. */
    TEST_ASSERT_EQUAL_UINT64(0u, keel_stats_mean_us(&stats));
    stats.runs = 3u;
    TEST_ASSERT_EQUAL_UINT64(333u, keel_stats_mean_us(&stats));
    stats.runs = 1u;
    TEST_ASSERT_EQUAL_UINT64(1000u, keel_stats_mean_us(&stats));
}

/* What decisions reckon with, and for how many runs within the budget of 100 still. */
static void remembers(uint32_t remembered_us, uint32_t forgotten_in)
{
    TEST_ASSERT_EQUAL_UINT32(remembered_us, stats.remembered_us);
    TEST_ASSERT_EQUAL_UINT32(forgotten_in, stats.forgotten_in);
}

static void record_times(uint32_t elapsed_us, uint32_t times)
{
    for (uint32_t i = 0u; i < times; i++) {
        keel_stats_record(&stats, elapsed_us, 100u);
    }
}

static void STS_006_runs_within_the_budget_are_not_remembered(void)
{
    record_times(99u, 3u);
    record_times(100u, 3u);
    remembers(0u, 0u);
}

static void STS_006_the_longest_overrun_is_remembered(void)
{
    record_times(101u, 1u);
    remembers(101u, 8u);
    record_times(500u, 1u);
    remembers(500u, 8u);
    record_times(300u, 1u);
    remembers(500u, 8u);
    record_times(UINT32_MAX, 1u);
    remembers(UINT32_MAX, 8u);
}

static void STS_006_eight_runs_within_the_budget_forget_it(void)
{
    record_times(500u, 1u);
    record_times(100u, 1u);
    remembers(500u, 7u);
    record_times(0u, 6u);
    remembers(500u, 1u);
    record_times(100u, 1u);
    remembers(0u, 0u);
    TEST_ASSERT_EQUAL_UINT32(500u, stats.longest_us); /* What is reported stays. */
    TEST_ASSERT_EQUAL_UINT16(1u, stats.overruns);
    record_times(100u, 9u);
    remembers(0u, 0u);
}

static void STS_006_an_overrun_starts_the_count_anew(void)
{
    record_times(500u, 1u);
    record_times(100u, 7u);
    remembers(500u, 1u);
    record_times(101u, 1u); /* Shorter than what is remembered, which stays. */
    remembers(500u, 8u);
    record_times(100u, 7u);
    remembers(500u, 1u);
    record_times(100u, 1u);
    remembers(0u, 0u);
}

static void STS_006_what_was_forgotten_does_not_come_back(void)
{
    record_times(500u, 1u);
    record_times(100u, 8u);
    record_times(150u, 1u);
    remembers(150u, 8u);
}

static void STS_006_promotions_forget_nothing(void)
{
    record_times(500u, 1u);
    keel_stats_promote(&stats);
    remembers(500u, 8u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(STS_001_last_and_longest_run);
    RUN_TEST(STS_002_only_a_longer_run_overruns);
    RUN_TEST(STS_002_overruns_stop_at_their_limit);
    RUN_TEST(STS_003_runs_and_their_sum);
    RUN_TEST(STS_003_mean_freezes_when_runs_are_full);
    RUN_TEST(STS_003_mean_freezes_when_the_sum_is_full);
    RUN_TEST(STS_004_promotions_stop_at_their_limit);
    RUN_TEST(STS_005_mean_rounds_down);
    RUN_TEST(STS_006_runs_within_the_budget_are_not_remembered);
    RUN_TEST(STS_006_the_longest_overrun_is_remembered);
    RUN_TEST(STS_006_eight_runs_within_the_budget_forget_it);
    RUN_TEST(STS_006_an_overrun_starts_the_count_anew);
    RUN_TEST(STS_006_what_was_forgotten_does_not_come_back);
    RUN_TEST(STS_006_promotions_forget_nothing);
    return UNITY_END();
}
