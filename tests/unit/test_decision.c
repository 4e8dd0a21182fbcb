/* SPDX-License-Identifier: Apache-2.0 */
/* Unit tests of keel/internal/rtos/decision.h. Expected values are worked out by hand. */
#include "keel/internal/rtos/decision.h"
#include "unity.h"

#include <string.h>

#define TASKS 6u

static keel_queue_t queue;
static keel_task_config_t config[TASKS];
static uint32_t made;

void setUp(void)
{
    memset(&queue, 0, sizeof queue);
    memset(config, 0, sizeof config);
    keel_queue_init(&queue);
    made = 0u;
}

void tearDown(void)
{
}

static void body(void *context)
{
    (void)context;
}

/* Queues a task with period 1000 and budget 100, and gives its slot. */
static uint32_t queued(uint32_t priority, uint64_t release_us)
{
    const uint32_t slot = queue.order[queue.count];

    config[made] = (keel_task_config_t){NULL, body, NULL, 1000u, 100u, 0u, priority};
    keel_queue_add(&queue, &config[made], release_us);
    made++;
    return slot;
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

static void DEC_002_the_earliest_realtime_release(void)
{
    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_REALTIME, 700u);
    queued(KEEL_PRIORITY_REALTIME, 800u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_earliest_us(&queue));
}

static void DEC_002_first_and_last_count(void)
{
    const uint32_t first = queued(KEEL_PRIORITY_REALTIME, 600u);
    const uint32_t last = queued(KEEL_PRIORITY_REALTIME, 0x100000000u);

    TEST_ASSERT_EQUAL_UINT64(600u, keel_decision_earliest_us(&queue));
    queue.release_us[first] = 0x100000001u;
    TEST_ASSERT_EQUAL_UINT64(0x100000000u, keel_decision_earliest_us(&queue));
    queue.release_us[last] = 0u;
    TEST_ASSERT_EQUAL_UINT64(0u, keel_decision_earliest_us(&queue));
}

static void DEC_002_never_without_realtime_tasks(void)
{
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_earliest_us(&queue));
    queued(KEEL_PRIORITY_HIGH, 10u);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_earliest_us(&queue));
}

static void DEC_005_room_is_the_slack_less_the_guard(void)
{
    TEST_ASSERT_EQUAL_UINT32(680u, keel_decision_room_us(700u, 0u, 20u));
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_room_us(700u, 679u, 20u));
    TEST_ASSERT_EQUAL_UINT32(700u, keel_decision_room_us(700u, 0u, 0u));
}

static void DEC_005_no_room_in_the_guard_or_when_a_task_is_due(void)
{
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_room_us(700u, 680u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_room_us(700u, 699u, 20u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_room_us(700u, 700u, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_room_us(700u, 5000u, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_room_us(700u, 5000u, UINT32_MAX));
}

static void DEC_005_room_stops_at_its_limit(void)
{
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_decision_room_us(UINT64_MAX, 0u, 20u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_decision_room_us(0x100000013u, 0u, 20u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX - 1u, keel_decision_room_us(0x100000012u, 0u, 20u));
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, keel_decision_room_us(0x100000014u, 0u, 20u));
}

#define NOBODY UINT32_MAX

/* The position of the choice among the other tasks, or NOBODY. */
static uint32_t with_room(uint64_t now_us, uint32_t room_us)
{
    const keel_choice_t choice = keel_decision_other(&queue, now_us, room_us, false);

    return (choice.priority > 0u) ? choice.position : NOBODY;
}

/* The same with endless slack. */
static uint32_t choice(uint64_t now_us)
{
    return with_room(now_us, UINT32_MAX);
}

static void DEC_003_only_released_tasks_run(void)
{
    queued(KEEL_PRIORITY_LOW, 500u);
    TEST_ASSERT_EQUAL_UINT32(NOBODY, choice(499u));
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
    uint32_t other;

    queued(KEEL_PRIORITY_REALTIME, 0u);
    other = queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, choice(0u));
    queue.release_us[other] = 10u;
    TEST_ASSERT_EQUAL_UINT32(NOBODY, choice(0u));
}

static void DEC_003_worst_case_just_fits_the_room(void)
{
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, 100u));
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, 99u));
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, 0u));
}

static void DEC_003_worst_case_is_budget_or_remembered_overrun(void)
{
    const uint32_t slot = queued(KEEL_PRIORITY_LOW, 0u);

    queue.stats[slot].remembered_us = 150u;
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, 149u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, 150u));
    queue.stats[slot].remembered_us = 50u;
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, 99u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, 100u));
}

/* The longest run is reported; decisions do not look at it. */
static void DEC_003_a_long_run_that_was_forgotten_is_not_reckoned_with(void)
{
    queue.stats[queued(KEEL_PRIORITY_LOW, 0u)].longest_us = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, 99u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, 100u));
}

static void DEC_003_the_longest_worst_case(void)
{
    queue.stats[queued(KEEL_PRIORITY_LOW, 0u)].remembered_us = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(0u, UINT32_MAX - 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, UINT32_MAX));
}

static void DEC_003_lower_priority_runs_when_the_higher_does_not_fit(void)
{
    queue.stats[queued(KEEL_PRIORITY_HIGH, 0u)].remembered_us = 500u;
    queued(KEEL_PRIORITY_LOW, 0u);
    TEST_ASSERT_EQUAL_UINT32(1u, with_room(0u, 499u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(0u, 500u));
}

static void DEC_003_promoted_runs_without_slack(void)
{
    queued(KEEL_PRIORITY_HIGH, 0u);
    /* Age 3.75 periods is 2.75 periods behind its release. */
    TEST_ASSERT_EQUAL_UINT32(NOBODY, with_room(2749u, 0u));
    TEST_ASSERT_EQUAL_UINT32(0u, with_room(2750u, 0u));
}

static void DEC_003_promoted_are_served_first_come_first(void)
{
    queued(KEEL_PRIORITY_HIGH, 20000u);
    queued(KEEL_PRIORITY_LOW, 6000u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    /* The first is fresh, the second and third promoted: the third has waited longer. */
    TEST_ASSERT_EQUAL_UINT32(1u, choice(20000u));
}

/* The same where none is promoted. */
static keel_choice_t without_promotion(uint64_t now_us, uint32_t room_us)
{
    return keel_decision_other(&queue, now_us, room_us, true);
}

static void DEC_003_without_promotion_none_runs_that_does_not_fit(void)
{
    queued(KEEL_PRIORITY_HIGH, 0u);
    TEST_ASSERT_EQUAL_UINT32(0u, without_promotion(2750u, 99u).priority);
    TEST_ASSERT_EQUAL_UINT32(0u, without_promotion(1000000000u, 99u).priority);
    TEST_ASSERT_EQUAL_UINT32(16u, without_promotion(2750u, 100u).priority);
    TEST_ASSERT_EQUAL_UINT32(12u, without_promotion(1750u, 100u).priority); /* 1 + 4 * 2.75 */
}

static void DEC_003_without_promotion_the_order_is_the_same(void)
{
    uint32_t low;

    queued(KEEL_PRIORITY_HIGH, 20000u);
    low = queued(KEEL_PRIORITY_LOW, 6000u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    /* 5, and twice the highest. */
    TEST_ASSERT_EQUAL_UINT32(1u, without_promotion(20000u, 100u).position);
    queue.stats[low].remembered_us = 101u;
    TEST_ASSERT_EQUAL_UINT32(2u, without_promotion(20000u, 100u).position);
    TEST_ASSERT_EQUAL_UINT64(0u, without_promotion(20000u, 0u).earliest_us);
}

static void DEC_003_empty_queue(void)
{
    TEST_ASSERT_EQUAL_UINT32(NOBODY, choice(0u));
}

/* 1 + 3 * age / T for a task that is late by less than its period, and by more. */
static void DEC_003_dynamic_priority_of_the_choice(void)
{
    queued(KEEL_PRIORITY_MEDIUM_HIGH, 5000u);
    TEST_ASSERT_EQUAL_UINT32(0u, keel_decision_other(&queue, 4999u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(4u, keel_decision_other(&queue, 5000u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(4u, keel_decision_other(&queue, 5333u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(5u, keel_decision_other(&queue, 5334u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(6u, keel_decision_other(&queue, 5999u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(7u, keel_decision_other(&queue, 6000u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(15u, keel_decision_other(&queue, 8999u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(16u, keel_decision_other(&queue, 9000u, 100u, false).priority);
    TEST_ASSERT_EQUAL_UINT32(16u, keel_decision_other(&queue, 9000000u, 100u, false).priority);
}

static void DEC_003_tells_the_earliest_release_of_the_others(void)
{
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_other(&queue, 0u, 0u, false).earliest_us);
    queued(KEEL_PRIORITY_REALTIME, 100u);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_other(&queue, 0u, 0u, false).earliest_us);
    queued(KEEL_PRIORITY_HIGH, 800u);
    queued(KEEL_PRIORITY_LOW, 700u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_other(&queue, 0u, 0u, false).earliest_us);
    /* Also when that task does not run, and when another does. */
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_other(&queue, 750u, 0u, false).earliest_us);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_other(&queue, 900u, 100u, false).earliest_us);
}

static void DEC_004_event_is_the_first_release(void)
{
    uint32_t realtime;

    queued(KEEL_PRIORITY_LOW, 700u);
    queued(KEEL_PRIORITY_HIGH, 800u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 0u, false));
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 699u, false));
    realtime = queued(KEEL_PRIORITY_REALTIME, 600u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 0u, false));
    queue.release_us[realtime] = 0u;
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 0u, false));
}

static void DEC_004_event_is_a_promotion(void)
{
    uint32_t low;

    queued(KEEL_PRIORITY_HIGH, 700u);
    /* Released but too long: promoted 2.75 periods behind its release. */
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 699u, false));
    TEST_ASSERT_EQUAL_UINT64(3450u, keel_decision_event_us(&queue, 700u, false));
    TEST_ASSERT_EQUAL_UINT64(3450u, keel_decision_event_us(&queue, 2000u, false));
    low = queued(KEEL_PRIORITY_LOW, 3000u);
    TEST_ASSERT_EQUAL_UINT64(3000u, keel_decision_event_us(&queue, 2000u, false));
    /* Promoted 14 periods behind its release. */
    queue.release_us[low] = 0u;
    TEST_ASSERT_EQUAL_UINT64(3450u, keel_decision_event_us(&queue, 2000u, false));
}

static void DEC_004_without_promotion_only_releases_are_events(void)
{
    queued(KEEL_PRIORITY_HIGH, 700u);
    TEST_ASSERT_EQUAL_UINT64(700u, keel_decision_event_us(&queue, 699u, true));
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_event_us(&queue, 700u, true));
    queued(KEEL_PRIORITY_LOW, 5000u);
    TEST_ASSERT_EQUAL_UINT64(5000u, keel_decision_event_us(&queue, 700u, true));
}

static void DEC_004_never_an_event_without_others(void)
{
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_event_us(&queue, 0u, false));
    queued(KEEL_PRIORITY_REALTIME, 900u);
    TEST_ASSERT_EQUAL_UINT64(UINT64_MAX, keel_decision_event_us(&queue, 5000u, false));
}

static void DEC_004_decisions_change_nothing(void)
{
    keel_queue_t before;

    queued(KEEL_PRIORITY_REALTIME, 900u);
    queued(KEEL_PRIORITY_HIGH, 0u);
    queued(KEEL_PRIORITY_LOW, 0u);
    memcpy(&before, &queue, sizeof before);
    TEST_ASSERT_EQUAL_UINT32(1u, keel_decision_realtime(&queue, 0u, 1u, 5u));
    TEST_ASSERT_EQUAL_UINT64(900u, keel_decision_earliest_us(&queue));
    TEST_ASSERT_EQUAL_UINT32(1u, choice(5u));
    TEST_ASSERT_EQUAL_UINT64(2750u, keel_decision_event_us(&queue, 5u, false));
    TEST_ASSERT_EQUAL_MEMORY(&before, &queue, sizeof queue);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(DEC_001_first_due_realtime_task_runs);
    RUN_TEST(DEC_001_due_at_its_release_and_not_before);
    RUN_TEST(DEC_001_looks_at_its_part_alone);
    RUN_TEST(DEC_002_the_earliest_realtime_release);
    RUN_TEST(DEC_002_first_and_last_count);
    RUN_TEST(DEC_002_never_without_realtime_tasks);
    RUN_TEST(DEC_005_room_is_the_slack_less_the_guard);
    RUN_TEST(DEC_005_no_room_in_the_guard_or_when_a_task_is_due);
    RUN_TEST(DEC_005_room_stops_at_its_limit);
    RUN_TEST(DEC_003_only_released_tasks_run);
    RUN_TEST(DEC_003_highest_dynamic_priority_runs);
    RUN_TEST(DEC_003_age_beats_class);
    RUN_TEST(DEC_003_ties_go_to_the_first_queued);
    RUN_TEST(DEC_003_realtime_tasks_are_not_looked_at);
    RUN_TEST(DEC_003_worst_case_just_fits_the_room);
    RUN_TEST(DEC_003_worst_case_is_budget_or_remembered_overrun);
    RUN_TEST(DEC_003_a_long_run_that_was_forgotten_is_not_reckoned_with);
    RUN_TEST(DEC_003_the_longest_worst_case);
    RUN_TEST(DEC_003_lower_priority_runs_when_the_higher_does_not_fit);
    RUN_TEST(DEC_003_promoted_runs_without_slack);
    RUN_TEST(DEC_003_promoted_are_served_first_come_first);
    RUN_TEST(DEC_003_without_promotion_none_runs_that_does_not_fit);
    RUN_TEST(DEC_003_without_promotion_the_order_is_the_same);
    RUN_TEST(DEC_003_empty_queue);
    RUN_TEST(DEC_003_dynamic_priority_of_the_choice);
    RUN_TEST(DEC_003_tells_the_earliest_release_of_the_others);
    RUN_TEST(DEC_004_event_is_the_first_release);
    RUN_TEST(DEC_004_event_is_a_promotion);
    RUN_TEST(DEC_004_without_promotion_only_releases_are_events);
    RUN_TEST(DEC_004_never_an_event_without_others);
    RUN_TEST(DEC_004_decisions_change_nothing);
    return UNITY_END();
}
