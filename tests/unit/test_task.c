/* Unit tests of keel/rtos/task.h. Expected values are worked out by hand. */
#include "keel/rtos/task.h"
#include "unity.h"

#include <string.h>

static void body(void *context)
{
    (void)context;
}

static keel_task_config_t config;
static keel_task_t task;

void setUp(void)
{
    memset(&config, 0, sizeof config);
    memset(&task, 0, sizeof task);
    config.run = body;
    config.period_us = 100u;
    config.budget_us = 10u;
    config.phase_us = 7u;
    config.priority = KEEL_PRIORITY_LOW;
    task.config = &config;
}

void tearDown(void)
{
}

static void TSK_001_realtime_is_the_realtime_priority_alone(void)
{
    static const uint32_t others[] = {1u, 2u, 3u, 4u, 15u, 17u};

    config.priority = KEEL_PRIORITY_REALTIME;
    TEST_ASSERT_TRUE(keel_task_is_realtime(&task));
    for (size_t i = 0u; i < (sizeof others / sizeof others[0]); i++) {
        config.priority = others[i];
        TEST_ASSERT_FALSE(keel_task_is_realtime(&task));
    }
}

static void TSK_002_valid_declarations_pass(void)
{
    static const uint32_t priorities[] = {1u, 2u, 3u, 4u, 16u};

    for (size_t i = 0u; i < (sizeof priorities / sizeof priorities[0]); i++) {
        config.priority = priorities[i];
        TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    }
}

static void TSK_002_null_is_refused(void)
{
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(NULL));
    config.run = NULL;
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(&config));
}

static void TSK_002_period_at_its_limits(void)
{
    config.phase_us = 0u;
    config.period_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.period_us = 0x7FFFFFFFu;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.period_us = 0x80000000u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
}

static void TSK_002_phase_at_its_limit(void)
{
    config.phase_us = 99u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.phase_us = 100u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
    config.phase_us = UINT32_MAX;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
}

static void TSK_002_budget_at_its_limit(void)
{
    config.budget_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_task_check(&config));
    config.budget_us = 0u;
    TEST_ASSERT_EQUAL(KEEL_ERR_BUDGET_ZERO, keel_task_check(&config));
}

static void TSK_002_unknown_priorities_are_refused(void)
{
    static const uint32_t wrong[] = {0u, 5u, 15u, 17u, UINT32_MAX};

    for (size_t i = 0u; i < (sizeof wrong / sizeof wrong[0]); i++) {
        config.priority = wrong[i];
        TEST_ASSERT_EQUAL(KEEL_ERR_PRIORITY, keel_task_check(&config));
    }
}

/* Everything is wrong at first; mending one thing at a time brings out the next reason. */
static void TSK_002_first_reason_is_reported(void)
{
    config = (keel_task_config_t){NULL, NULL, NULL, 0u, 0u, 100u, 0u};
    TEST_ASSERT_EQUAL(KEEL_ERR_NULL, keel_task_check(&config));
    config.run = body;
    TEST_ASSERT_EQUAL(KEEL_ERR_PERIOD, keel_task_check(&config));
    config.period_us = 100u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PHASE, keel_task_check(&config));
    config.phase_us = 99u;
    TEST_ASSERT_EQUAL(KEEL_ERR_BUDGET_ZERO, keel_task_check(&config));
    config.budget_us = 1u;
    TEST_ASSERT_EQUAL(KEEL_ERR_PRIORITY, keel_task_check(&config));
}

static void TSK_003_arm_sets_the_release_and_clears_the_rest(void)
{
    task.skipped = 3u;
    task.release_us = 4u;
    task.stats = (keel_stats_t){1u, 2u, 3u, 4u, 5u, 6u};
    keel_task_arm(&task, 5000000000u);
    TEST_ASSERT_EQUAL_UINT64(5000000007u, task.release_us);
    TEST_ASSERT_EQUAL_UINT32(0u, task.skipped);
    TEST_ASSERT_EQUAL_UINT64(0u, task.stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(0u, task.stats.runs);
    TEST_ASSERT_EQUAL_UINT32(0u, task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(0u, task.stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(0u, task.stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(0u, task.stats.promotions);
    TEST_ASSERT_EQUAL_PTR(&config, task.config);
}

/* A task with period 100, released at 1000, is served at now_us. */
static void advances(uint64_t now_us, uint64_t release_us, uint32_t skipped)
{
    task.skipped = 0u;
    task.release_us = 1000u;
    keel_task_advance(&task, now_us);
    TEST_ASSERT_EQUAL_UINT64(release_us, task.release_us);
    TEST_ASSERT_EQUAL_UINT32(skipped, task.skipped);
}

static void TSK_004_release_stays_on_the_grid(void)
{
    advances(1000u, 1100u, 0u);
    advances(1001u, 1100u, 0u);
    advances(1099u, 1100u, 0u);
}

static void TSK_004_missed_periods_are_skipped_and_counted(void)
{
    advances(1100u, 1200u, 1u);
    advances(1199u, 1200u, 1u);
    advances(1349u, 1400u, 3u);
    advances(1400u, 1500u, 4u);
}

static void TSK_004_skipped_adds_up(void)
{
    task.release_us = 1000u;
    keel_task_advance(&task, 1250u); /* 2 missed, next 1300 */
    keel_task_advance(&task, 1600u); /* 3 missed, next 1700 */
    TEST_ASSERT_EQUAL_UINT32(5u, task.skipped);
    TEST_ASSERT_EQUAL_UINT64(1700u, task.release_us);
}

static void TSK_004_skipped_stops_at_its_limit(void)
{
    task.release_us = 1000u;
    task.skipped = UINT16_MAX - 2u;
    keel_task_advance(&task, 1250u); /* 2 missed: exactly the limit */
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, task.skipped);
    keel_task_advance(&task, 1400u); /* 1 missed: stays there */
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, task.skipped);
    TEST_ASSERT_EQUAL_UINT64(1500u, task.release_us);
}

static void TSK_004_more_than_2_32_missed_periods(void)
{
    config.period_us = 1u;
    task.release_us = 0u;
    keel_task_advance(&task, 0x100000005u);
    TEST_ASSERT_EQUAL_UINT32(UINT16_MAX, task.skipped);
    TEST_ASSERT_EQUAL_UINT64(0x100000006u, task.release_us);
}

static void TSK_004_statistics_are_left_alone(void)
{
    task.release_us = 1000u;
    task.stats = (keel_stats_t){1u, 2u, 3u, 4u, 5u, 6u};
    keel_task_advance(&task, 1250u);
    TEST_ASSERT_EQUAL_UINT64(1u, task.stats.total_us);
    TEST_ASSERT_EQUAL_UINT32(2u, task.stats.runs);
    TEST_ASSERT_EQUAL_UINT32(3u, task.stats.last_us);
    TEST_ASSERT_EQUAL_UINT32(4u, task.stats.longest_us);
    TEST_ASSERT_EQUAL_UINT16(5u, task.stats.overruns);
    TEST_ASSERT_EQUAL_UINT16(6u, task.stats.promotions);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(TSK_001_realtime_is_the_realtime_priority_alone);
    RUN_TEST(TSK_002_valid_declarations_pass);
    RUN_TEST(TSK_002_null_is_refused);
    RUN_TEST(TSK_002_period_at_its_limits);
    RUN_TEST(TSK_002_phase_at_its_limit);
    RUN_TEST(TSK_002_budget_at_its_limit);
    RUN_TEST(TSK_002_unknown_priorities_are_refused);
    RUN_TEST(TSK_002_first_reason_is_reported);
    RUN_TEST(TSK_003_arm_sets_the_release_and_clears_the_rest);
    RUN_TEST(TSK_004_release_stays_on_the_grid);
    RUN_TEST(TSK_004_missed_periods_are_skipped_and_counted);
    RUN_TEST(TSK_004_skipped_adds_up);
    RUN_TEST(TSK_004_skipped_stops_at_its_limit);
    RUN_TEST(TSK_004_more_than_2_32_missed_periods);
    RUN_TEST(TSK_004_statistics_are_left_alone);
    return UNITY_END();
}
