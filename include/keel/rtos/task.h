/**
 * @file task.h
 * @brief A task: what its programmer declares, and what the kernel keeps about it.
 *
 * The paper's task model: every task is periodic, its deadline is the end of its period, and
 * nothing preempts it. The declaration is a constant that can live in flash, so that a table of
 * tasks is data that an analyser can read; what changes is a small block of RAM apart from it.
 */
#ifndef KEEL_RTOS_TASK_H
#define KEEL_RTOS_TASK_H

#include "keel/rtos/clock.h"
#include "keel/rtos/load.h"
#include "keel/rtos/priority.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/** The body of a task: runs once per release, to its end. */
typedef void (*keel_task_fn_t)(void *context);

/** A task, as its programmer declares it. Must not change while the task is in a queue. */
typedef struct keel_task_config {
    const char *name;   /**< For reports; may be null. */
    keel_task_fn_t run; /**< The body. */
    void *context;      /**< Handed to the body; may be null. */
    uint32_t period_us; /**< Period T and relative deadline, 1 to 2^31 - 1 us. */
    uint32_t budget_us; /**< Declared worst-case execution time, at least 1 us. */
    uint32_t phase_us;  /**< First release after the start, less than a period, in us. */
    uint32_t priority;  /**< KEEL_PRIORITY_LOW to KEEL_PRIORITY_HIGH, or KEEL_PRIORITY_REALTIME. */
} keel_task_config_t;

/**
 * A task, as the kernel runs it. The caller owns the memory and sets config; the kernel writes
 * the rest when the task is added, and while it is in the queue. Read it freely.
 */
typedef struct keel_task {
    const keel_task_config_t *config; /**< What the programmer declared. */
    uint16_t skipped;                 /**< Whole periods passed unserved; stays at UINT16_MAX. */
    uint64_t release_us;              /**< The next release to serve, on the task's grid, in us. */
    keel_stats_t stats;               /**< How its runs went. */
} keel_task_t;

/*@ predicate realtime(keel_task_t *task) =
  @     task->config->priority == KEEL_PRIORITY_REALTIME;
  @
  @ predicate config_valid(keel_task_config_t *config) =
  @     config->run != \null && period_valid(config->period_us) && 0 < config->budget_us &&
  @     config->phase_us < config->period_us && priority_valid(config->priority);
  @*/

/**
 * Whether the FCFS half of the scheduler serves the task.
 *
 * @param task a task
 */
/*@ requires \valid_read(task) && \valid_read(task->config);
  @ assigns \nothing;
  @ ensures TSK_001: \result <==> realtime(task);
  @*/
static inline bool keel_task_is_realtime(const keel_task_t *task)
{
    return task->config->priority == KEEL_PRIORITY_REALTIME;
}

/**
 * Checks a declaration by itself, before it meets others (requirement TSK-002).
 *
 * @param config the declaration, or null
 * @return KEEL_OK, or the first that applies of KEEL_ERR_NULL (also for a null body),
 *         KEEL_ERR_PERIOD, KEEL_ERR_PHASE, KEEL_ERR_BUDGET_ZERO, KEEL_ERR_PRIORITY
 */
/*@ requires config == \null || \valid_read(config);
  @ assigns \nothing;
  @ behavior null:
  @   assumes config == \null || config->run == \null;
  @   ensures TSK_002_null: \result == KEEL_ERR_NULL;
  @ behavior period:
  @   assumes config != \null && config->run != \null;
  @   assumes !period_valid(config->period_us);
  @   ensures TSK_002_period: \result == KEEL_ERR_PERIOD;
  @ behavior phase:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us >= config->period_us;
  @   ensures TSK_002_phase: \result == KEEL_ERR_PHASE;
  @ behavior budget:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us < config->period_us;
  @   assumes config->budget_us == 0;
  @   ensures TSK_002_budget: \result == KEEL_ERR_BUDGET_ZERO;
  @ behavior priority:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us < config->period_us;
  @   assumes config->budget_us > 0 && !priority_valid(config->priority);
  @   ensures TSK_002_priority: \result == KEEL_ERR_PRIORITY;
  @ behavior valid:
  @   assumes config != \null && config_valid(config);
  @   ensures TSK_002_valid: \result == KEEL_OK;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_task_check(const keel_task_config_t *config);

/**
 * Arms a task: sets its first release on the grid and clears its statistics (requirement TSK-003).
 *
 * @param task     a task with its declaration set
 * @param start_us when the grid's phase is counted from, in us
 */
/*@ requires \valid(task) && \valid_read(task->config) && \separated(task, task->config);
  @ requires start_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns task->skipped, task->release_us, STATS_FIELDS(task->stats);
  @ ensures TSK_003_release: task->release_us == start_us + task->config->phase_us;
  @ ensures TSK_003_skipped: task->skipped == 0;
  @ ensures TSK_003_stats: stats_fresh(task->stats);
  @*/
void keel_task_arm(keel_task_t *task, uint64_t start_us);

/**
 * Moves a released task's release on to the first point of its grid behind the present, and
 * counts the whole periods that were missed (requirement TSK-004). The grid never shifts, so the
 * task does not drift however late it runs.
 *
 * @param task   a task that is due
 * @param now_us the time, not before the task's release, in us
 */
/*@ requires \valid(task) && \valid_read(task->config) && \separated(task, task->config);
  @ requires period_valid(task->config->period_us);
  @ requires task->release_us <= now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns task->skipped, task->release_us;
  @ ensures TSK_004_grid: task->release_us == \old(task->release_us)
  @     + ((now_us - \old(task->release_us)) / task->config->period_us + 1)
  @       * task->config->period_us;
  @ ensures TSK_004_next: now_us < task->release_us <= now_us + task->config->period_us;
  @ ensures TSK_004_on_time: now_us < \old(task->release_us) + task->config->period_us ==>
  @     task->release_us == \old(task->release_us) + task->config->period_us &&
  @     task->skipped == \old(task->skipped);
  @ ensures TSK_004_skipped: task->skipped == \min(UINT16_MAX, \old(task->skipped)
  @     + (now_us - \old(task->release_us)) / task->config->period_us);
  @*/
void keel_task_advance(keel_task_t *task, uint64_t now_us);

#endif
