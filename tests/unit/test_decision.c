/* Unit tests of keel/rtos/decision.h. Expected values are worked out by hand. */
#include "keel/rtos/decision.h"
#include "unity.h"

#include <string.h>

#define TASKS 6u

static keel_queue_t queue;
static keel_task_config_t config[TASKS];
static keel_task_t task[TASKS];
static uint32_t made;

void setUp(void)
{
    memset(&queue, 0, sizeof queue);
    memset(config, 0, sizeof config);
    memset(task, 0, sizeof task);
    made = 0u;
}

void tearDown(void)
{
}

static void body(void *context)
{
    (void)context;
}

/* Queues a task with period 1000 and budget 100. */
static keel_task_t *queued(uint32_t priority, uint64_t release_us)
{
    keel_task_t *const added = &task[made];

    config[made] = (keel_task_config_t){NULL, body, NULL, 1000u, 100u, 0u, priority};
    added->config = &config[made];
    added->release_us = release_us;
    TEST_ASSERT_EQUAL(KEEL_OK, keel_queue_add(&queue, added));
    made++;
    return added;
}

static void DEC_001_first_due_realtime_task_runs(void)
{
    queued(KEEL_PRIORITY_REALTIME, 500u);
    queued(KEEL_PRIORITY_REALTIME, 300u);
    queued(KEEL_PRIORITY_REALTIME, 200u);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_realtime(&queue, 0u, 3u, 499u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_realtime(&queue, 0u, 3u, 500u));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_decision_realtime(&queue, 0u, 3u, 299u));
}

static void DEC_001_due_at_its_release_and_not_before(void)
{
    queued(KEEL_PRIORITY_REALTIME, 500u);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_realtime(&queue, 0u, 1u, 499u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_realtime(&queue, 0u, 1u, 500u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_realtime(&queue, 0u, 1u, 99999u));
}

static void DEC_001_looks_at_its_part_alone(void)
{
    queued(KEEL_PRIORITY_REALTIME, 0u);
    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_REALTIME, 0u);
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(2u, keel_decision_realtime(&queue, 1u, 3u, 10u));
    TEST_ASSERT_EQUAL_UINT32(2u, keel_decision_realtime(&queue, 1u, 2u, 10u)); /* none: to */
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_realtime(&queue, 0u, 0u, 10u));
    TEST_ASSERT_EQUAL_UINT32(3u, keel_decision_realtime(&queue, 3u, 3u, 10u));
}

static void DEC_002_slack_is_the_time_to_the_first_realtime_release(void)
{
    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_REALTIME, 700u);
    queued(KEEL_PRIORITY_REALTIME, 800u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_slack_us(&queue, 0u));
    TEST_ASSERT_EQUAL_UINT64(1u, keel_decision_slack_us(&queue, 699u));
}

static void DEC_002_no_slack_when_a_realtime_task_is_due(void)
{
    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_REALTIME, 700u);
    TEST_ASSERT_EQUAL_UINT64(0u, keel_decision_slack_us(&queue, 700u));
    TEST_ASSERT_EQUAL_UINT64(0u, keel_decision_slack_us(&queue, 800u));
}

static void DEC_002_endless_without_realtime_tasks(void)
{
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_slack_us(&queue, 0u));
    queued(KEEL_PRIORITY_HIGH, 10u);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_slack_us(&queue, 0u));
}

/* The choice among the other tasks with endless slack and no guard. */
static uint32_t choice(uint64_t now_us)
{
    return keel_decision_other(&queue, now_us, KEEL_TIME_NEVER_US, 0u);
}

static void DEC_003_only_released_tasks_run(void)
{
    queued(KEEL_PRIORITY_LOW, 500u);
    TEST_ASSERT_EQUAL_UINT32(1u, choice(499u));
    TEST_ASSERT_EQUAL_UINT32(0u, choice(500u));
}

static void DEC_003_highest_dynamic_priority_runs(void)
{
    queued(KEEL_PRIORITY_LOW, 0u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    queued(KEEL_PRIORITY_MEDIUM, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, choice(0u)); /* 2, 5, 3 */
}

static void DEC_003_age_beats_class(void)
{
    queued(KEEL_PRIORITY_HIGH, 4000u);
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, choice(4000u)); /* 1 + 4 = 5 and 1 + 5 = 6 */
    TEST_ASSERT_EQUAL_UINT32(0u, choice(4250u)); /* 1 + 5 = 6 and 1 + 5.25 = 6: first queued */
}

static void DEC_003_ties_go_to_the_first_queued(void)
{
    queued(KEEL_PRIORITY_MEDIUM, 700u);
    queued(KEEL_PRIORITY_MEDIUM, 700u);
    queued(KEEL_PRIORITY_MEDIUM, 600u);
    /* 1 + 2 * 1.0 = 3 three times; the third's 1 + 2 * 1.1 is 3 as well. */
    TEST_ASSERT_EQUAL_UINT32(0u, choice(700u));
}

static void DEC_003_realtime_tasks_are_not_looked_at(void)
{
    queued(KEEL_PRIORITY_REALTIME, 0u);
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, choice(0u));
    task[1].release_us = 10u;
    TEST_ASSERT_EQUAL_UINT32(2u, choice(0u));
}

static void DEC_003_worst_case_and_guard_just_fit(void)
{
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 0u, 120u, 20u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 119u, 20u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 120u, 21u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 0u, 0u));
}

static void DEC_003_worst_case_is_budget_or_longest_run(void)
{
    queued(KEEL_PRIORITY_LOW, 0u)->stats.longest_us = 150u;
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 169u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 0u, 170u, 20u));
    task[0].stats.longest_us = 50u;
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 119u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 0u, 120u, 20u));
}

static void DEC_003_worst_case_and_guard_do_not_wrap(void)
{
    queued(KEEL_PRIORITY_LOW, 0u)->stats.longest_us = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 0xFFFFFFFFu, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 0u, 0x100000000u, 1u));
}

static void DEC_003_lower_priority_runs_when_the_higher_does_not_fit(void)
{
    queued(KEEL_PRIORITY_HIGH, 0u)->stats.longest_us = 500u;
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 0u, 400u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 0u, 520u, 20u));
}

static void DEC_003_promoted_runs_without_slack(void)
{
    queued(KEEL_PRIORITY_HIGH, 0u);
    /* Age 3.75 periods is 2.75 periods behind its release. */
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 2749u, 0u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 2750u, 0u, 20u));
}

static void DEC_003_promoted_are_served_first_come_first(void)
{
    queued(KEEL_PRIORITY_HIGH, 20000u);
    queued(KEEL_PRIORITY_LOW, 6000u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    /* The first is fresh, the second and third promoted: the third has waited longer. */
    TEST_ASSERT_EQUAL_UINT32(1u, choice(20000u));
}

static void DEC_003_empty_queue(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, choice(0u));
}

static void DEC_004_wakes_at_the_first_release(void)
{
    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_LOW, 700u);
    queued(KEEL_PRIORITY_HIGH, 800u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_wake_us(&queue, 0u));
    task[0].release_us = 600u;
    TEST_ASSERT_EQUAL_UINT64(600u, keel_decision_wake_us(&queue, 0u));
}

static void DEC_004_wakes_at_a_promotion(void)
{
    queued(KEEL_PRIORITY_REALTIME, 9000u);
    queued(KEEL_PRIORITY_HIGH, 700u);
    /* Released but too long: promoted 2.75 periods behind its release. */
    TEST_ASSERT_EQUAL_UINT64(3450u, keel_decision_wake_us(&queue, 700u));
    TEST_ASSERT_EQUAL_UINT64(3450u, keel_decision_wake_us(&queue, 2000u));
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_wake_us(&queue, 699u));
    task[0].release_us = 3000u;
    TEST_ASSERT_EQUAL_UINT64(3000u, keel_decision_wake_us(&queue, 2000u));
}

static void DEC_004_wakes_at_once_for_a_due_realtime_task(void)
{
    queued(KEEL_PRIORITY_REALTIME, 900u);
    TEST_ASSERT_EQUAL_UINT64(900u, keel_decision_wake_us(&queue, 900u));
    TEST_ASSERT_EQUAL_UINT64(900u, keel_decision_wake_us(&queue, 5000u));
}

static void DEC_004_never_wakes_for_an_empty_queue(void)
{
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_wake_us(&queue, 0u));
}

static void DEC_004_decisions_change_nothing(void)
{
    keel_queue_t queue_before;
    keel_task_t task_before[TASKS];

    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    queued(KEEL_PRIORITY_LOW, 0u);
    memcpy(&queue_before, &queue, sizeof queue_before);
    memcpy(task_before, task, sizeof task_before);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_realtime(&queue, 0u, 1u, 5u));
    TEST_ASSERT_EQUAL_UINT64(895u, keel_decision_slack_us(&queue, 5u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_other(&queue, 5u, 895u, 0u));
    TEST_ASSERT_EQUAL_UINT64(900u, keel_decision_wake_us(&queue, 5u));
    TEST_ASSERT_EQUAL_MEMORY(&queue_before, &queue, sizeof queue);
    TEST_ASSERT_EQUAL_MEMORY(task_before, task, sizeof task);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(DEC_001_first_due_realtime_task_runs);
    RUN_TEST(DEC_001_due_at_its_release_and_not_before);
    RUN_TEST(DEC_001_looks_at_its_part_alone);
    RUN_TEST(DEC_002_slack_is_the_time_to_the_first_realtime_release);
    RUN_TEST(DEC_002_no_slack_when_a_realtime_task_is_due);
    RUN_TEST(DEC_002_endless_without_realtime_tasks);
    RUN_TEST(DEC_003_only_released_tasks_run);
    RUN_TEST(DEC_003_highest_dynamic_priority_runs);
    RUN_TEST(DEC_003_age_beats_class);
    RUN_TEST(DEC_003_ties_go_to_the_first_queued);
    RUN_TEST(DEC_003_realtime_tasks_are_not_looked_at);
    RUN_TEST(DEC_003_worst_case_and_guard_just_fit);
    RUN_TEST(DEC_003_worst_case_is_budget_or_longest_run);
    RUN_TEST(DEC_003_worst_case_and_guard_do_not_wrap);
    RUN_TEST(DEC_003_lower_priority_runs_when_the_higher_does_not_fit);
    RUN_TEST(DEC_003_promoted_runs_without_slack);
    RUN_TEST(DEC_003_promoted_are_served_first_come_first);
    RUN_TEST(DEC_003_empty_queue);
    RUN_TEST(DEC_004_wakes_at_the_first_release);
    RUN_TEST(DEC_004_wakes_at_a_promotion);
    RUN_TEST(DEC_004_wakes_at_once_for_a_due_realtime_task);
    RUN_TEST(DEC_004_never_wakes_for_an_empty_queue);
    RUN_TEST(DEC_004_decisions_change_nothing);
    return UNITY_END();
}
