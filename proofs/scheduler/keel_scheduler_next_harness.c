// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_next dispatch is_promoted close_pass
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a full queue of two real-time and two other tasks, with periods, budgets and runs up
// to 2^2 us and times below 2^4 us: eq. 3 and the grid divide. The capacity is that of the queue,
// as a slot that may be empty hides from the solver how small the numbers are. The contract under
// WP has no such bound, and the decisions have harnesses of their own at the shipped capacity.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

#define REALTIME 2u
#define MOST     4u

/* The dynamic priority with which a task competes: 0 when it may not run. */
static uint32_t competing(const keel_scheduler_t *scheduler, const keel_task_t *task)
{
    const uint64_t now_us = scheduler->clock.now_us;
    const uint32_t period_us = task->config->period_us;
    bool fits = true;
    uint32_t priority;

    if (task->release_us > now_us) {
        return 0u;
    }
    for (uint32_t j = 0u; j < REALTIME; j++) {
        const uint64_t release_us = proof_task[j]->release_us;
        const uint64_t end_us = now_us + scheduler->config.guard_us;

        fits = fits && ((end_us + task->config->budget_us) <= release_us) &&
               ((end_us + task->stats.longest_us) <= release_us);
    }
    priority = dynamic_priority(task->config->priority, (now_us - task->release_us) + period_us,
                                period_us);
    return (fits || (priority == 16u)) ? priority : 0u;
}

void keel_scheduler_next_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    uint32_t priority[MOST];
    uint32_t due = MOST;
    uint32_t best = MOST;
    uint64_t now_us;
    keel_scheduler_t before;
    keel_task_t task_before[MOST];
    const keel_task_t *task;

    queue_of(&scheduler.queue, REALTIME, MOST);
    narrow_tasks(MOST, 2u, 4u);
    any_state(&scheduler);
    scheduler.clock.now_us = any_bits64(4u);
    scheduler.busy_us = 0u;
    scheduler.config.guard_us = any_bits(3u);
    now_us = scheduler.clock.now_us;
    before = scheduler;
    for (uint32_t k = 0u; k < MOST; k++) {
        task_before[k] = *proof_task[k];
        priority[k] = (k < REALTIME) ? 0u : competing(&scheduler, proof_task[k]);
        if ((due == MOST) && (scheduler.cursor <= k) && (k < scheduler.pass_end) &&
            (proof_task[k]->release_us <= now_us)) {
            due = k;
        }
        if ((priority[k] > 0u) && ((best == MOST) || (priority[k] > priority[best]))) {
            best = k;
        }
    }

    __CPROVER_assume(keel_scheduler_next_may(&scheduler));
    task = keel_scheduler_next(&scheduler);

    __CPROVER_assert(keel_scheduler_next_does(task, &before, &scheduler),
                     "SCH_020_part: as the step takes it to do");

    assert_scheduler_valid(&scheduler);
    if (before.stage != KEEL_STAGE_PASS) {
        __CPROVER_assert((task == NULL) && scheduler_same(&scheduler, &before, i),
                         "SCH_014_closed: with no pass open nothing runs, nothing changes");
    } else if (due < MOST) {
        __CPROVER_assert(task == proof_task[due],
                         "SCH_015_first: the first due real-time task of the pass runs");
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_REALTIME) && (scheduler.running == due) &&
                             (scheduler.cursor == (due + 1u)),
                         "SCH_015_realtime: the pass goes on behind it");
    } else if (best < MOST) {
        __CPROVER_assert(task == proof_task[best],
                         "SCH_016_highest: the first eligible of the highest priority runs");
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_OTHER) && (scheduler.running == best) &&
                             (scheduler.cursor == scheduler.pass_end),
                         "SCH_016_class: as the one other task of the pass");
    } else {
        __CPROVER_assert((task == NULL) && (scheduler.stage == KEEL_STAGE_READY),
                         "SCH_016_none: with none eligible the pass is over");
        __CPROVER_assert(!before.ran || (scheduler.wake_us == 0u),
                         "SCH_012_wake: after a pass that ran a task the next step looks anew");
        for (uint32_t k = 0u; k < MOST; k++) {
            __CPROVER_assert((scheduler.wake_us <= now_us) || (k >= REALTIME) ||
                                 (scheduler.wake_us <= proof_task[k]->release_us),
                             "SCH_012_wake: no real-time task is released before it");
        }
    }
    for (uint32_t k = 0u; k < MOST; k++) {
        const keel_task_t *const now = proof_task[k];

        if (task == now) {
            __CPROVER_assert(task_before[k].release_us <= now_us,
                             "SCH_014_released: only a released task runs");
            __CPROVER_assert((now_us < now->release_us) &&
                                 (now->release_us <= (now_us + now->config->period_us)),
                             "SCH_014_release: its next release lies ahead");
            __CPROVER_assert((now_us >= (task_before[k].release_us + now->config->period_us)) ||
                                 (now->release_us ==
                                  (task_before[k].release_us + now->config->period_us)),
                             "SCH_014_on_time: on its grid");
            __CPROVER_assert((k < REALTIME) || (priority[k] < 16u) ||
                                 (task_before[k].stats.promotions == UINT16_MAX) ||
                                 (now->stats.promotions > task_before[k].stats.promotions),
                             "SCH_016_promoted: a promotion is counted");
        } else {
            __CPROVER_assert(task_same(now, &task_before[k]),
                             "SCH_014_others: no other task is written");
        }
    }
    __CPROVER_assert(queue_same(&scheduler.queue, &before.queue, i) &&
                         clock_same(&scheduler.clock, &before.clock) &&
                         (scheduler.busy_us == before.busy_us) &&
                         (scheduler.pass_end == before.pass_end),
                     "SCH_014_frame: queue and time stay");
}
