/**
 * @file add_proof.h
 * @brief What a task that was added leaves of a scheduler: for the harnesses of adding.
 */
#ifndef ADD_PROOF_H
#define ADD_PROOF_H

#include "keel_scheduler_proof.h"

/* Asserts what adding the task of interest did to a scheduler, as seen at a position and slot. */
static void assert_added(const keel_scheduler_t *scheduler, const keel_scheduler_t *before,
                         uint32_t i)
{
    const bool realtime = proof_task.priority == KEEL_PRIORITY_REALTIME;
    const uint32_t place = realtime ? before->queue.realtime_count : before->queue.count;
    const uint32_t slot = before->queue.order[before->queue.count];
    keel_scheduler_t expected = *before;

    expected.queue.count++;
    expected.queue.realtime_count += realtime ? 1u : 0u;
    expected.queue.order[i] = scheduler->queue.order[i];
    __CPROVER_assert(scheduler->queue.order[i] ==
                         ((i == place) ? slot
                                       : (((place < i) && (i <= before->queue.count))
                                              ? before->queue.order[(i - 1u) % CAPACITY]
                                              : before->queue.order[i])),
                     "SCH_004_order: it stands last of its class, those behind it move down");
    expected.queue.task[slot] = &proof_task;
    expected.queue.period_us[slot] = proof_task.period_us;
    expected.queue.budget_us[slot] = proof_task.budget_us;
    expected.queue.priority[slot] = (uint8_t)proof_task.priority;
    __CPROVER_assert((scheduler->queue.task[slot] == &proof_task) &&
                         (scheduler->queue.period_us[slot] == proof_task.period_us) &&
                         (scheduler->queue.budget_us[slot] == proof_task.budget_us) &&
                         (scheduler->queue.priority[slot] == proof_task.priority),
                     "SCH_004_copied: with what is declared");
    expected.queue.skipped[slot] = 0u;
    expected.queue.stats[slot] = (keel_stats_t){0};
    __CPROVER_assert((scheduler->queue.skipped[slot] == 0u) &&
                         stats_fresh(&scheduler->queue.stats[slot]),
                     "SCH_004_fresh: with nothing counted");
    expected.queue.release_us[slot] = before->clock.now_us + proof_task.phase_us;
    __CPROVER_assert(scheduler->queue.release_us[slot] == expected.queue.release_us[slot],
                     "SCH_004_release: its first release is a phase from now");
    if (realtime && ((int16_t)place <= before->running)) {
        expected.running++;
    }
    __CPROVER_assert(scheduler->running == expected.running,
                     "SCH_004_running: the running task is still known");
    expected.wake_us = 0u;
    expected.earliest_realtime_us = 0u;
    expected.earliest_other_us = 0u;
    __CPROVER_assert((scheduler->wake_us == 0u) && (scheduler->earliest_realtime_us == 0u) &&
                         (scheduler->earliest_other_us == 0u),
                     "SCH_004_wake: nothing is known of the releases");
    __CPROVER_assert(scheduler_same(scheduler, &expected, i),
                     "SCH_004_frame: nothing else is written");
}

#endif
