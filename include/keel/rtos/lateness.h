/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file lateness.h
 * @brief How late a real-time task starts at the latest, by the isolation theorems.
 *
 * The lateness of a start is the time since the task's release. Its bound is also one of the
 * release jitter that schedulability tests ask for.
 *
 *     keel_scheduler_add(&s, &gyro);                    for every task
 *     keel_scheduler_lateness(&s, &gyro, &lateness);    before the start, or at any time
 *
 * The numbers are those of the theorems, with the budgets as they were declared. Asked for before
 * the start, they hold while each budget is kept, the clock is read within the guard, no task is
 * added, and none is removed but between two steps (specs/soundness.md, Isolation).
 */
#ifndef KEEL_RTOS_LATENESS_H
#define KEEL_RTOS_LATENESS_H

#include "keel/c_declarations.h"
#include "keel/rtos/admission.h"
#include "keel/rtos/scheduler_state.h"
#include "keel/rtos/task.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/**
 * The bounds of a task's starts. KEEL_TIME_NEVER_US stands for no bound: only real-time tasks have
 * one.
 */
typedef struct keel_lateness {
    uint64_t late_us;       /**< It starts at most so long after its release, in us. */
    uint64_t unpromoted_us; /**< The same, as long as no task is promoted, in us. */
    bool promotes;          /**< Whether one may ever be; if not, both bounds are the same. */
    bool skips;             /**< Whether whole periods of the task may be skipped. */
} keel_lateness_t;

/**
 * Tells how late a task starts at the latest (requirements LAT-001 and LAT-002). May be called at
 * any time; the result is for the tasks that are queued then.
 *
 * @param scheduler the scheduler
 * @param task      the task; it is compared, never read
 * @param lateness  receives the bounds; a refusal leaves it as it is
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_UNKNOWN_TASK: it is not in the queue; what
 *         keel_scheduler_check says of tasks that cannot be scheduled; in this order
 */
keel_status_t keel_scheduler_lateness(const keel_scheduler_t *scheduler,
                                      const keel_task_config_t *task, keel_lateness_t *lateness);

KEEL_C_END

#endif
