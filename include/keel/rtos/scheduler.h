/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file scheduler.h
 * @brief The hybrid scheduler: FCFS for real-time tasks, EDF with dynamic priority for the others.
 *
 * A step is a pass: every due real-time task in queue order, then at most one other task, the clock
 * read before each decision. While nothing can be due, it is a clock reading and a comparison.
 *
 *     static const keel_task_config_t gyro = {.name = "gyro", .run = read_gyro, ...};
 *
 *     keel_scheduler_init(&s, &config);
 *     keel_scheduler_add(&s, &gyro);        for every task
 *     keel_scheduler_spread(&s, &crowded);  where tasks have no phases of their own: spread.h
 *     keel_scheduler_start(&s);             admission; from here on time counts
 *     for (;;) {
 *         keel_scheduler_step(&s);
 *         sleep_for_us(keel_scheduler_idle_us(&s, LATENCY_US, LONGEST_US));    or poll
 *     }
 *
 * A task is its declaration, a constant, whose address is its handle. While it runs it may add and
 * remove tasks, itself too, but change nothing else. scheduler_state.h has the fields, and tells
 * what the choice between promotion and none means for tasks of either class.
 */
#ifndef KEEL_RTOS_SCHEDULER_H
#define KEEL_RTOS_SCHEDULER_H

#include "keel/c_declarations.h"
#include "keel/rtos/admission.h"
#include "keel/rtos/scheduler_state.h"
#include "keel/rtos/task.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/**
 * Prepares a scheduler without tasks (requirement SCH-001).
 *
 * @param scheduler the scheduler
 * @param config    how; it is copied
 * @return KEEL_OK; KEEL_ERR_NULL, also for a null clock; KEEL_ERR_CONFIG: guard or limit too high
 */
keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config);

/**
 * Checks whether the tasks can be scheduled, and names the first that cannot (SCH-003). The rules
 * are the same with and without promotion; which bound then holds: keel_scheduler_config_t.
 *
 * @param scheduler the scheduler
 * @param admitted  receives how many tasks are admitted: on refusal, the offender's position
 * @return KEEL_OK, or the offender's KEEL_ERR_REALTIME_DEMAND, _BUDGET_GAP or _UTILISATION
 */
keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted);

/**
 * Adds a task (requirement SCH-004). Before the start it is only checked by itself; afterwards it
 * is also admitted with the rest of the set, and its first release is its phase from now. Added by
 * a running task, a real-time task waits for the next pass; another may be chosen in this one.
 *
 * @param scheduler the scheduler
 * @param task      the declaration, which must outlive the task's stay and not change meanwhile
 * @return KEEL_OK; KEEL_ERR_NULL, what keel_task_check says, KEEL_ERR_DUPLICATE, KEEL_ERR_FULL,
 *         after the start what keel_admission_admit says; in this order
 */
keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, const keel_task_config_t *task);

/**
 * Removes a task (requirement SCH-007), also from inside a running task, and the running one; no
 * task is then skipped or run twice in the pass.
 *
 * @param scheduler the scheduler
 * @param task      the task to remove; it is compared, never read
 * @return KEEL_OK, KEEL_ERR_NULL, or KEEL_ERR_UNKNOWN_TASK when it is not in the queue
 */
keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task);

/**
 * Reads the clock and starts the scheduler: time begins at 0 with this reading, and every task's
 * first release is its phase (requirement SCH-009).
 *
 * @param scheduler a scheduler that was not started yet, or null
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE: started before; what keel_scheduler_check says
 */
keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler);

/**
 * One step: a pass over the tasks, if any can be due (requirement SCH-020). To be called for ever,
 * at most 2^31 - 1 us apart; for the isolation theorems (specs/soundness.md) at most W apart, but
 * for sleeps as keel_scheduler_idle_us allows them.
 *
 * @param scheduler a started scheduler, or null
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE before the start and from within a task;
 *         KEEL_ERR_CLOCK when the clock jumped backwards: see keel_scheduler_resync
 */
keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler);

/**
 * How long a loop may sleep before its next step (requirement SCH-028): keel_pass_idle_us with the
 * clock as it reads now. Such a sleep, or a shorter one, loses no release: no step meanwhile would
 * run a task, and the isolation theorems hold as for a loop that polls (specs/soundness.md). It
 * gives the processor to an RTOS' other threads, or to a core that waits for an interrupt.
 *
 * @param scheduler  a scheduler between two steps, or null
 * @param latency_us how long after the sleep the next step reads the clock, at most
 * @param longest_us what the sleep may last at most, for a watchdog that must be fed
 * @return how long, in us; 0 when a task may be due within the latency, for null, before the start,
 *         from within a task, and when the clock jumped backwards
 */
uint32_t keel_scheduler_idle_us(const keel_scheduler_t *scheduler, uint32_t latency_us,
                                uint32_t longest_us);

/**
 * Takes up a clock that has jumped, as if no time had passed (requirement SCH-021).
 *
 * @param scheduler a scheduler between two steps, or null
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE before the start and from within a task
 */
keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler);

/**
 * The task at a position of the queue, to walk through all (requirement SCH-024).
 *
 * @param scheduler the scheduler, or null
 * @param position  0 for the first
 * @return the task's declaration; null when there is no task at this position, or no scheduler
 */
const keel_task_config_t *keel_scheduler_task(const keel_scheduler_t *scheduler, uint32_t position);

/**
 * Copies out what is known of a task (requirement SCH-025). May be called at any time.
 *
 * @param scheduler the scheduler
 * @param task      the task; it is compared, never read
 * @param report    receives the copy; a refusal leaves it as it is
 * @return KEEL_OK, KEEL_ERR_NULL, or KEEL_ERR_UNKNOWN_TASK when the task is not in the queue
 */
keel_status_t keel_scheduler_report(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *task, keel_task_report_t *report);

KEEL_C_END

#endif
