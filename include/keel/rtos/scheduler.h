/**
 * @file scheduler.h
 * @brief The hybrid scheduler: FCFS for real-time tasks, EDF with dynamic priority for the others.
 *
 * One step of the scheduler is a pass: every due real-time task in queue order, the clock read
 * again before each decision, then at most one other task. Between passes, while nothing can be
 * due, a step costs a clock reading and a comparison.
 *
 *     keel_scheduler_init(&s, &config);
 *     keel_scheduler_add(&s, &task);        for every task
 *     keel_scheduler_start(&s, &offender);  admission; sets every task's first release
 *     for (;;) { keel_scheduler_step(&s); }
 *
 * A step is made of three smaller operations, which never call a task: begin opens the pass, next
 * decides and hands out the task to run, finish takes its statistics. They are public because the
 * proofs speak of them, and for those who want a loop of their own.
 *
 * A task may add and remove tasks, itself included, while it runs.
 */
#ifndef KEEL_RTOS_SCHEDULER_H
#define KEEL_RTOS_SCHEDULER_H

#include "keel/rtos/admission.h"
#include "keel/rtos/clock.h"
#include "keel/rtos/decision.h"
#include "keel/rtos/queue.h"
#include "keel/rtos/task.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

/** Reads a free-running counter of microseconds, which wraps at 2^32. */
typedef uint32_t (*keel_clock_fn_t)(void *context);

/** How a scheduler is set up. */
typedef struct keel_scheduler_config {
    keel_clock_fn_t read_clock; /**< The clock. */
    void *clock_context;        /**< Handed to read_clock; may be null. */
    uint32_t guard_us;          /**< W of eq. 2: time for a decision, below 2^31 us. */
    uint32_t utilisation_limit; /**< Highest utilisation, at most KEEL_UTILISATION_FULL_PPM. */
} keel_scheduler_config_t;

/* What the scheduler is doing. Plain numbers: an enumeration's size differs between compilers. */
#define KEEL_STAGE_SETUP    0u /**< Tasks are being added; not started. */
#define KEEL_STAGE_READY    1u /**< Between two passes. */
#define KEEL_STAGE_PASS     2u /**< In a pass, about to decide. */
#define KEEL_STAGE_REALTIME 3u /**< A real-time task is running. */
#define KEEL_STAGE_OTHER    4u /**< Another task is running. */

/** The index that no task has. */
#define KEEL_INDEX_NONE UINT32_MAX

/** A scheduler. Its caller owns the memory; read it freely, only the functions below write it. */
typedef struct keel_scheduler {
    keel_queue_t queue;             /**< The tasks. */
    keel_scheduler_config_t config; /**< As given to keel_scheduler_init. */
    keel_clock_t clock;             /**< The time of the last clock reading. */
    uint64_t wake_us;               /**< Before this time no task can run, in us. */
    uint64_t busy_us;               /**< Time spent in tasks since the start, in us. */
    uint32_t stage;                 /**< One of KEEL_STAGE_*. */
    uint32_t cursor;                /**< In a pass: the next index that FCFS looks at. */
    uint32_t pass_end;              /**< In a pass: where its real-time tasks end. */
    uint32_t running;               /**< The running task's index, or KEEL_INDEX_NONE. */
    bool ran;                       /**< In a pass: whether it has run a task. */
} keel_scheduler_t;

/*@ predicate stage_running(keel_scheduler_t *s) =
  @     s->stage == KEEL_STAGE_REALTIME || s->stage == KEEL_STAGE_OTHER;
  @
  @ // In a pass the cursor lies within the pass, the pass within the real-time tasks.
  @ predicate scheduler_pass(keel_scheduler_t *s) =
  @     s->cursor <= s->pass_end <= s->queue.realtime_count;
  @
  @ predicate scheduler_running(keel_scheduler_t *s) =
  @     s->running == KEEL_INDEX_NONE || s->running < s->queue.count;
  @
  @ // The configuration as keel_scheduler_init accepted it.
  @ predicate scheduler_configured(keel_scheduler_t *s) =
  @     s->config.guard_us < KEEL_PERIOD_LIMIT_US &&
  @     s->config.utilisation_limit <= KEEL_UTILISATION_FULL_PPM;
  @
  @ predicate scheduler_stage(keel_scheduler_t *s) = s->stage <= KEEL_STAGE_OTHER;
  @
  @ // Tasks and declarations are memory apart from the scheduler ...
  @ predicate scheduler_apart(keel_scheduler_t *s) =
  @     (\forall integer i; 0 <= i < s->queue.count ==> \separated(s, s->queue.task[i])) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==> \separated(s, s->queue.task[i]->config));
  @
  @ // ... from each other ...
  @ predicate tasks_apart(keel_scheduler_t *s) =
  @     \forall integer i, j; 0 <= i < j < s->queue.count ==>
  @         \separated(s->queue.task[i], s->queue.task[j]);
  @
  @ // ... and declarations, which may be shared, from all tasks.
  @ predicate configs_apart(keel_scheduler_t *s) =
  @     \forall integer i, j; 0 <= i < s->queue.count ==> 0 <= j < s->queue.count ==>
  @         \separated(s->queue.task[i], s->queue.task[j]->config);
  @
  @ predicate scheduler_valid(keel_scheduler_t *s) =
  @     queue_valid(&s->queue) && queue_checked(&s->queue) && scheduler_pass(s) &&
  @     scheduler_running(s) && scheduler_configured(s) && scheduler_stage(s) &&
  @     scheduler_apart(s) && tasks_apart(s) && configs_apart(s);
  @
  @ predicate in_uptime(keel_scheduler_t *s) = s->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @*/

keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config);
keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted);
keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, keel_task_t *task);
keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, keel_task_t *task);
keel_status_t keel_scheduler_start_at(keel_scheduler_t *scheduler, uint32_t raw_us);
keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler);
keel_status_t keel_scheduler_begin(keel_scheduler_t *scheduler, uint32_t raw_us);
keel_task_t *keel_scheduler_next(keel_scheduler_t *scheduler);
keel_status_t keel_scheduler_finish(keel_scheduler_t *scheduler, uint32_t raw_us);
keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler);
keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler);

#endif
