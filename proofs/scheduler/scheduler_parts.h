/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file scheduler_parts.h
 * @brief The parts of add, remove, check and start that are proved by themselves.
 *
 * The model runs first. What admission says of the scheduler's queue, and of a newcomer, is the
 * same unknown for the model and for the code; the order that the queue is left in is what the
 * model has left. So every number has its full width, and the queue the shipped capacity.
 */
#ifndef SCHEDULER_PARTS_H
#define SCHEDULER_PARTS_H

#include "../../specs/model/scheduler.h"
#include "../common/admission_contracts.h"
#include "../common/keel_scheduler_proof.h"
#include "../common/queue_contracts.h"

keel_admission_t nondet_admission(void);

static uint32_t at; /* The position and the slot at which all is seen. */
static keel_scheduler_t scheduler;
static keel_scheduler_t before;
static keel_scheduler_t expected; /* What the model leaves. */

/* What admission says. */
static keel_admission_t totals;
static keel_status_t set_status;
static keel_status_t newcomer_status;

static void any_parts(uint32_t of_interest)
{
    any_scheduler(&scheduler, of_interest);
    totals = nondet_admission();
    set_status = (keel_status_t)any_below(KEEL_ERR_UTILISATION + 1u);
    newcomer_status = (keel_status_t)any_below(KEEL_ERR_UTILISATION + 1u);
    before = scheduler;
    expected = scheduler;
}

/* Whether admission begins with the totals of no task. */
static bool is_empty(const keel_admission_t *admission)
{
    const keel_admission_t empty = {.guard_us = before.config.guard_us,
                                    .utilisation_limit_ppm = before.config.utilisation_limit_ppm,
                                    .shortest_realtime_us = UINT64_MAX,
                                    .shortest_gap_us = UINT64_MAX};

    return totals_same(admission, &empty);
}

/* Of no consequence: the totals are an unknown. */
void model_admission_init(keel_admission_t *admission, uint32_t guard_us,
                          uint32_t utilisation_limit_ppm)
{
    (void)admission;
    (void)guard_us;
    (void)utilisation_limit_ppm;
}

keel_status_t model_admission_queue(keel_admission_t *admission, const keel_queue_t *queue)
{
    *admission = totals;
    __CPROVER_assume(keel_admission_queue_does(set_status, admission, queue));
    return set_status;
}

keel_status_t keel_admission_queue_stand_in(keel_admission_t *admission, const keel_queue_t *queue)
{
    __CPROVER_assert(keel_admission_queue_may(admission, queue),
                     "precondition: keel_admission_queue");
    __CPROVER_assert(is_empty(admission) && (queue == &scheduler.queue) &&
                         scheduler_same(&scheduler, &before, at),
                     "SCH_003_asked: the whole queue is admitted, as it is");
    *admission = totals;
    __CPROVER_assume(keel_admission_queue_does(set_status, admission, queue));
    return set_status;
}

keel_status_t model_admission_admit(keel_admission_t *admission, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us)
{
    (void)admission;
    (void)priority;
    (void)period_us;
    (void)budget_us;
    return newcomer_status;
}

keel_status_t keel_admission_admit_stand_in(keel_admission_t *admission, uint32_t priority,
                                            uint32_t period_us, uint32_t budget_us)
{
    __CPROVER_assert(keel_admission_admit_may(admission, period_us, budget_us),
                     "precondition: keel_admission_admit");
    __CPROVER_assert(totals_same(admission, &totals) && (priority == proof_task.priority) &&
                         (period_us == proof_task.period_us) && (budget_us == proof_task.budget_us),
                     "SCH_004_asked: the newcomer is admitted with the rest of the set");
    __CPROVER_assume(keel_admission_admit_does(newcomer_status, admission, admission));
    return newcomer_status;
}

void keel_queue_add_stand_in(keel_queue_t *queue, const keel_task_config_t *task,
                             uint64_t release_us)
{
    __CPROVER_assert(keel_queue_add_may(queue, task), "precondition: keel_queue_add");
    __CPROVER_assert((queue == &scheduler.queue) && queue_same(queue, &before.queue, at) &&
                         (task == &proof_task) &&
                         (release_us == (before.clock.now_us + proof_task.phase_us)),
                     "SCH_004_asked: the task, to be released a phase from now");
    *queue = expected.queue;
    __CPROVER_assume(keel_queue_add_does(queue, &expected.queue, at));
}

void keel_queue_remove_stand_in(keel_queue_t *queue, uint32_t position)
{
    __CPROVER_assert(keel_queue_remove_may(queue, position), "precondition: keel_queue_remove");
    __CPROVER_assert((queue == &scheduler.queue) && queue_same(queue, &before.queue, at) &&
                         (queue->task[queue->order[position]] == &proof_task),
                     "SCH_007_asked: the task that is removed");
    *queue = expected.queue;
    __CPROVER_assume(keel_queue_remove_does(queue, &expected.queue, at));
}

#endif
