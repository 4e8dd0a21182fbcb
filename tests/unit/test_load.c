/* Unit tests of keel/rtos/load.h. Expected values are worked out by hand. */
#include "keel/rtos/load.h"
#include "unity.h"

#include <string.h>

static keel_stats_t stats;
static keel_deviation_t deviation;

void setUp(void)
{
    memset(&stats, 0, sizeof stats);
    memset(&deviation, 0, sizeof deviation);
}

void tearDown(void)
{
}

static void LOD_001_last_and_longest_run(void)
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

static void LOD_002_only_a_longer_run_overruns(void)
{
    keel_stats_record(&stats, 99u, 100u);
    keel_stats_record(&stats, 100u, 100u);
    TEST_ASSERT_EQUAL_UINT16(0u, stats.overruns);
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(1u, stats.overruns);
    keel_stats_record(&stats, UINT32_MAX, 100u);
    TEST_ASSERT_EQUAL_UINT16(2u, stats.overruns);
}

static void LOD_002_overruns_stop_at_their_limit(void)
{
    stats.overruns = UINT16_MAX - 1u;
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.overruns);
    keel_stats_record(&stats, 101u, 100u);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, stats.overruns);
    TEST_ASSERT_EQUAL_UINT32(2u, stats.runs);
}

static void LOD_003_runs_and_their_sum(void)
{
    keel_stats_record(&stats, 30u, 100u);
    keel_stats_record(&stats, 0u, 100u);
    keel_stats_record(&stats, 200u, 100u);
    TEST_ASSERT_EQUAL_UINT32(3u, stats.runs);
    TEST_ASSERT_EQUAL_UINT64(230u, stats.total_us);
}

static void LOD_003_mean_freezes_when_runs_are_full(void)
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

static void LOD_003_mean_freezes_when_the_sum_is_full(void)
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

static void LOD_004_promotions_stop_at_their_limit(void)
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

static void LOD_005_mean_rounds_down(void)
{
    TEST_ASSERT_EQUAL_UINT64(0u, keel_stats_mean_us(&stats));
    stats.total_us = 1000u; /* Not a run yet: still no mean. */
    TEST_ASSERT_EQUAL_UINT64(0u, keel_stats_mean_us(&stats));
    stats.runs = 3u;
    TEST_ASSERT_EQUAL_UINT64(333u, keel_stats_mean_us(&stats));
    stats.runs = 1u;
    TEST_ASSERT_EQUAL_UINT64(1000u, keel_stats_mean_us(&stats));
}

static void LOD_006_begin_notes_time_and_busy_time(void)
{
    keel_load_t load = {1u, 2u};

    keel_load_begin(&load, 5000000000u, 6000000u);
    TEST_ASSERT_EQUAL_UINT64(5000000000u, load.start_us);
    TEST_ASSERT_EQUAL_UINT64(6000000u, load.busy_us);
}

static void LOD_007_load_of_a_window(void)
{
    const keel_load_t load = {10000u, 2000u};

    TEST_ASSERT_EQUAL_UINT32(0u, keel_load_milli_percent(&load, 11000u, 2000u));
    TEST_ASSERT_EQUAL_UINT32(25000u, keel_load_milli_percent(&load, 11000u, 2250u));
    TEST_ASSERT_EQUAL_UINT32(33333u, keel_load_milli_percent(&load, 10003u, 2001u));
    TEST_ASSERT_EQUAL_UINT32(66666u, keel_load_milli_percent(&load, 10003u, 2002u));
    TEST_ASSERT_EQUAL_UINT32(100000u, keel_load_milli_percent(&load, 11000u, 3000u));
}

static void LOD_007_empty_window_is_idle(void)
{
    const keel_load_t load = {10000u, 2000u};

    TEST_ASSERT_EQUAL_UINT32(0u, keel_load_milli_percent(&load, 10000u, 2000u));
}

static void LOD_007_longest_window(void)
{
    const keel_load_t load = {7u, 0u};

    TEST_ASSERT_EQUAL_UINT32(100000u,
                             keel_load_milli_percent(&load, 7u + (uint64_t)UINT32_MAX, UINT32_MAX));
    /* 2^31 of 2^32 - 1: 50000.00001 thousandths of a percent. */
    TEST_ASSERT_EQUAL_UINT32(50000u, keel_load_milli_percent(&load, 7u + (uint64_t)UINT32_MAX,
                                                             0x80000000u));
}

static void LOD_008_first_start_ends_no_period(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 123456u, 1000u));
    TEST_ASSERT_EQUAL_UINT64(0u, deviation.sum_us2);
    TEST_ASSERT_EQUAL_UINT64(123456u, deviation.start_us);
    TEST_ASSERT_EQUAL_UINT32(1u, deviation.starts);
}

static void LOD_008_late_and_early_starts_add_their_squares(void)
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

static void LOD_008_farthest_sample_is_taken(void)
{
    deviation.starts = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1000u + 0xFFFFFFFFull, 1000u));
    TEST_ASSERT_EQUAL_UINT64(18446744065119617025ull, deviation.sum_us2);
}

static void LOD_008_sum_may_reach_its_limit(void)
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

static void LOD_009_full_count_is_refused(void)
{
    deviation.starts = UINT32_MAX;
    deviation.start_us = 500u;
    refuses(1500u);
    deviation.starts = UINT32_MAX - 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_deviation_add(&deviation, 1500u, 1000u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, deviation.starts);
}

static void LOD_009_farther_sample_is_refused(void)
{
    deviation.starts = 1u;
    refuses(1000u + 0x100000000ull);
    refuses(UINT64_MAX);
}

static void LOD_009_overflow_of_the_sum_is_refused(void)
{
    deviation.starts = 1u;
    deviation.sum_us2 = UINT64_MAX - 99u;
    refuses(1010u);
    refuses(990u);
}

static void LOD_010_variance_is_the_mean_square(void)
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
    RUN_TEST(LOD_001_last_and_longest_run);
    RUN_TEST(LOD_002_only_a_longer_run_overruns);
    RUN_TEST(LOD_002_overruns_stop_at_their_limit);
    RUN_TEST(LOD_003_runs_and_their_sum);
    RUN_TEST(LOD_003_mean_freezes_when_runs_are_full);
    RUN_TEST(LOD_003_mean_freezes_when_the_sum_is_full);
    RUN_TEST(LOD_004_promotions_stop_at_their_limit);
    RUN_TEST(LOD_005_mean_rounds_down);
    RUN_TEST(LOD_006_begin_notes_time_and_busy_time);
    RUN_TEST(LOD_007_load_of_a_window);
    RUN_TEST(LOD_007_empty_window_is_idle);
    RUN_TEST(LOD_007_longest_window);
    RUN_TEST(LOD_008_first_start_ends_no_period);
    RUN_TEST(LOD_008_late_and_early_starts_add_their_squares);
    RUN_TEST(LOD_008_farthest_sample_is_taken);
    RUN_TEST(LOD_008_sum_may_reach_its_limit);
    RUN_TEST(LOD_009_full_count_is_refused);
    RUN_TEST(LOD_009_farther_sample_is_refused);
    RUN_TEST(LOD_009_overflow_of_the_sum_is_refused);
    RUN_TEST(LOD_010_variance_is_the_mean_square);
    return UNITY_END();
}
