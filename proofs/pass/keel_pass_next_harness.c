// cbmc: --unwind 34
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/load.c
// replaces: keel_decision_other keel_decision_event_us keel_queue_advance
// covers: keel_pass_next dispatch find_realtime find_earliest_realtime choose_other
// covers: remember serve_other find_wake close_pass keel_stats_promote
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a capacity of 2 tasks. The functions that divide, or choose among many, are what their
// contracts say (decision_contracts.h, queue_contracts.h), dynamic priorities and times of
// promotion any. The contract under WP has no bound, and says alone that the wake-up time stays
// right (SCH_012_wake).
#include "../common/keel_scheduler_proof.h"
#include "../common/queue_contracts.h"
#include "../common/step_contracts.h"

keel_choice_t nondet_choice(void);

static uint32_t rival;    /* The position at which all is seen. */
static uint32_t advances; /* How often a release was moved on, the slot and the time. */
static uint32_t advanced_slot;
static uint64_t advanced_at_us;
static bool asked_event; /* Whether the next event was asked for, and what was said. */
static uint64_t told_event_us;

keel_choice_t keel_decision_other_stand_in(const keel_queue_t *queue, uint64_t now_us,
                                           uint32_t room_us)
{
    const keel_choice_t choice = nondet_choice();

    __CPROVER_assert(keel_decision_other_may(queue, now_us), "precondition: keel_decision_other");
    __CPROVER_assume(keel_decision_other_does(&choice, queue, now_us, room_us, rival));
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        __CPROVER_assume(!is_other(queue, i) ||
                         (choice.earliest_us <= queue->release_us[queue->order[i]]));
    }
    return choice;
}

uint64_t keel_decision_event_us_stand_in(const keel_queue_t *queue, uint64_t now_us)
{
    __CPROVER_assert(keel_decision_event_us_may(queue, now_us),
                     "precondition: keel_decision_event_us");
    told_event_us = nondet_u64();
    asked_event = true;
    __CPROVER_assume(keel_decision_event_us_does(told_event_us, queue, now_us, rival));
    return told_event_us;
}

void keel_queue_advance_stand_in(keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const keel_queue_t before = *queue;

    __CPROVER_assert(keel_queue_advance_may(queue, slot, now_us),
                     "precondition: keel_queue_advance");
    advances++;
    advanced_slot = slot;
    advanced_at_us = now_us;
    queue->release_us[slot] = nondet_u64();
    queue->skipped[slot] = nondet_u16();
    __CPROVER_assume(keel_queue_advance_does(&before, queue, slot, now_us, rival));
}

/* What a task that is served leaves as it was: all but who runs, its release and its promotions. */
static void assert_served(const keel_scheduler_t *scheduler, const keel_scheduler_t *before,
                          uint64_t earliest_us)
{
    const uint32_t i = rival;
    const uint32_t slot = scheduler->queue.order[scheduler->running];
    const uint32_t priority = may_run_with(before, scheduler->running, earliest_us);
    const bool is_promoted = (scheduler->stage == KEEL_STAGE_OTHER) && (priority == 16u);
    keel_scheduler_t expected = *before;

    __CPROVER_assert((advances == 1u) && (advanced_slot == slot) &&
                         (advanced_at_us == before->clock.now_us),
                     "SCH_014_moved: its release moves on along its grid, once");
    __CPROVER_assert(is_due(before, scheduler->running), "SCH_014_released: it was released");
    __CPROVER_assert(!is_due(scheduler, scheduler->running),
                     "SCH_014_release: its next release lies ahead");
    __CPROVER_assert(scheduler->wake_us == 0u, "SCH_012_pass: nothing waits while a task runs");
    if (scheduler->stage == KEEL_STAGE_OTHER) {
        __CPROVER_assert(is_other(&scheduler->queue, scheduler->running) &&
                             (scheduler->cursor == before->pass_end),
                         "SCH_016_class: as the one other task of the pass");
        __CPROVER_assert(priority > 0u, "SCH_016_fits: it fits the slack, or is promoted");
        __CPROVER_assert(may_run_with(before, i, earliest_us) <= priority,
                         "SCH_016_highest: none that may run has a higher dynamic priority");
        __CPROVER_assert((i >= scheduler->running) ||
                             (may_run_with(before, i, earliest_us) < priority),
                         "SCH_016_first: nor one before it the same");
        expected.earliest_realtime_us = scheduler->earliest_realtime_us;
        expected.earliest_other_us = scheduler->earliest_other_us;
    } else {
        __CPROVER_assert((before->cursor <= scheduler->running) &&
                             (scheduler->running < before->pass_end) &&
                             (scheduler->cursor == (scheduler->running + 1)),
                         "SCH_015_realtime: the pass goes on behind it");
        __CPROVER_assert((i < before->cursor) || (i >= scheduler->running) || !is_due(before, i),
                         "SCH_015_first: none of the pass before it is due");
    }
    if (is_promoted && (before->queue.stats[slot].promotions < UINT16_MAX)) {
        expected.queue.stats[slot].promotions++;
    }
    __CPROVER_assert(scheduler->queue.stats[slot].promotions ==
                         expected.queue.stats[slot].promotions,
                     "SCH_016_promotion: its promotion is counted, if it is one");
    expected.queue.release_us[slot] = scheduler->queue.release_us[slot];
    expected.queue.skipped[slot] = scheduler->queue.skipped[slot];
    expected.stage = scheduler->stage;
    expected.cursor = scheduler->cursor;
    expected.running = scheduler->running;
    __CPROVER_assert(scheduler_same(scheduler, &expected, i),
                     "SCH_014_others: nothing is written of any other task");
}

/* What a pass that closes leaves as it was: all but what is known of the releases. */
static void assert_closed(const keel_scheduler_t *scheduler, const keel_scheduler_t *before,
                          uint64_t earliest_us)
{
    const uint32_t i = rival;
    const uint32_t x = before->queue.order[i];
    keel_scheduler_t expected = *before;

    __CPROVER_assert(may_run_with(before, i, earliest_us) == 0u, "SCH_016_none: no other may run");
    __CPROVER_assert((i >= scheduler->queue.realtime_count) ||
                         (scheduler->wake_us <= scheduler->queue.release_us[x]),
                     "SCH_012_realtime: no real-time task is released before the wake-up time");
    __CPROVER_assert(!is_other(&scheduler->queue, i) ||
                         (scheduler->wake_us <=
                          event_of(&scheduler->queue, x, before->clock.now_us)),
                     "SCH_012_others: no other task is released or promoted before it");
    __CPROVER_assert((scheduler->wake_us == scheduler->earliest_realtime_us) ||
                         (scheduler->wake_us == scheduler->earliest_other_us) ||
                         (asked_event && (scheduler->wake_us == told_event_us)),
                     "SCH_012_exact: it is the time of one of these");
    expected.stage = KEEL_STAGE_READY;
    expected.cursor = before->pass_end;
    expected.wake_us = scheduler->wake_us;
    expected.earliest_realtime_us = scheduler->earliest_realtime_us;
    expected.earliest_other_us = scheduler->earliest_other_us;
    __CPROVER_assert((advances == 0u) && scheduler_same(scheduler, &expected, i),
                     "SCH_014_others: no task is taken into service, nothing else is written");
}

void keel_pass_next_harness(void)
{
    keel_scheduler_t scheduler;
    uint64_t earliest_us;
    bool due;
    keel_scheduler_t before;
    const keel_task_config_t *task;

    rival = any_below(CAPACITY);
    any_scheduler(&scheduler, CAPACITY);
    any_priorities();
    earliest_us = earliest_of(&scheduler);
    due = is_due(&scheduler, rival);
    before = scheduler;

    __CPROVER_assume(keel_pass_next_may(&scheduler));
    task = keel_pass_next(&scheduler);

    __CPROVER_assert(keel_pass_next_does(task, &before, &scheduler, rival, due),
                     "SCH_023_part: as the pass takes it to do");
    ASSERT_SCHEDULER_VALID(&scheduler);
    if (before.stage != KEEL_STAGE_PASS) {
        __CPROVER_assert((task == NULL) && scheduler_same(&scheduler, &before, rival),
                         "SCH_014_closed: with no pass open nothing runs, nothing changes");
    } else if (task != NULL) {
        __CPROVER_assert((0 <= scheduler.running) && (scheduler.running < scheduler.queue.count) &&
                             (task ==
                              scheduler.queue.task[scheduler.queue.order[scheduler.running]]),
                         "SCH_014_task: it is the task that runs");
        assert_served(&scheduler, &before, earliest_us);
    } else {
        __CPROVER_assert(scheduler.stage == KEEL_STAGE_READY, "SCH_014_stage: the pass is over");
        assert_closed(&scheduler, &before, earliest_us);
    }
    __CPROVER_assert((before.stage != KEEL_STAGE_PASS) ||
                         (scheduler.stage == KEEL_STAGE_REALTIME) || (rival < before.cursor) ||
                         (rival >= before.pass_end) || !due,
                     "SCH_015_none: a real-time task of the pass that is due goes first");
}
