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
 *     keel_scheduler_start(&s);             admission; sets every task's first release
 *     for (;;) { keel_scheduler_step(&s); }
 *
 * A step is made of three smaller operations, which never call a task: begin opens the pass, next
 * decides and hands out the task to run, finish takes its statistics. They are public because the
 * proofs speak of them, and for those who want a loop of their own. Run_pass is what follows begin
 * in a step, apart from it so that a step that waits is spared the cost.
 *
 * A task may add and remove tasks, itself included, while it runs. It calls nothing else of the
 * scheduler; a step from within a task is refused.
 *
 * The pieces begin, next, finish, run_pass, start_at and check take a scheduler that is not null;
 * the functions that only call them refuse a null one.
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
#define KEEL_INDEX_NONE UINT16_MAX

/** A scheduler. Its caller owns the memory; read it freely, only the functions below write it. */
typedef struct keel_scheduler {
    keel_queue_t queue;             /**< The tasks. */
    keel_scheduler_config_t config; /**< As given to keel_scheduler_init. */
    keel_clock_t clock;             /**< The time of the last clock reading. */
    uint64_t wake_us;               /**< Before this time no task can run, in us. */
    uint64_t busy_us;               /**< Time spent in tasks since the start, in us. */
    uint16_t cursor;                /**< In a pass: the next index that FCFS looks at. */
    uint16_t pass_end;              /**< In a pass: where its real-time tasks end. */
    uint16_t running;               /**< The running task's index, or KEEL_INDEX_NONE. */
    uint8_t stage;                  /**< One of KEEL_STAGE_*. */
    bool ran;                       /**< In a pass: whether it has run a task. */
} keel_scheduler_t;

/* clang-format off: the formatter does not know these clauses. */
/* The invariant of a scheduler as one clause for each part, which provers take one at a time. */
#define SCHEDULER_STAYS_VALID(s)                                                                   \
    ensures SCH_006_counts : queue_counts(&(s)->queue);                                            \
    ensures SCH_006_no_gaps : queue_no_gaps(&(s)->queue);                                          \
    ensures SCH_006_no_duplicates : queue_no_duplicates(&(s)->queue);                              \
    ensures SCH_006_tasks : queue_tasks_valid(&(s)->queue);                                        \
    ensures SCH_006_configs : queue_configs_valid(&(s)->queue);                                    \
    ensures SCH_006_realtime : queue_realtime_first(&(s)->queue);                                  \
    ensures SCH_006_others : queue_others_last(&(s)->queue);                                       \
    ensures SCH_006_checked : queue_checked(&(s)->queue);                                          \
    ensures SCH_006_apart : scheduler_apart(s);                                                    \
    ensures SCH_006_tasks_apart : tasks_apart(s);                                                  \
    ensures SCH_006_configs_apart : configs_apart(s);                                              \
    ensures SCH_006_state : scheduler_state(s);

/* What begin, next and finish leave alone: the set of tasks and what was declared of them. */
#define DECLARATIONS_STAY(s)                                                                       \
    ensures SCH_022_counts : (s)->queue.count == \old((s)->queue.count) &&                         \
        (s)->queue.realtime_count == \old((s)->queue.realtime_count) &&                            \
        (s)->config.guard_us == \old((s)->config.guard_us);                                        \
    ensures SCH_022_periods : period_same{Pre, Post}(s);                                           \
    ensures SCH_022_budgets : budget_same{Pre, Post}(s);
/* clang-format on */

/*@ predicate stage_running(keel_scheduler_t *s) =
  @     s->stage == KEEL_STAGE_REALTIME || s->stage == KEEL_STAGE_OTHER;
  @
  @ // In a pass the cursor lies within the pass, the pass within the real-time tasks; the running
  @ // task is in the queue; the configuration is as keel_scheduler_init accepted it.
  @ predicate scheduler_state(keel_scheduler_t *s) =
  @     s->cursor <= s->pass_end <= s->queue.realtime_count &&
  @     (s->running == KEEL_INDEX_NONE || s->running < s->queue.count) &&
  @     s->config.guard_us < KEEL_PERIOD_LIMIT_US &&
  @     s->config.utilisation_limit <= KEEL_UTILISATION_FULL_PPM &&
  @     s->stage <= KEEL_STAGE_OTHER && (s->stage >= KEEL_STAGE_PASS ==> s->wake_us == 0);
  @
  @ // Tasks are memory apart from the scheduler, declarations objects of their own ...
  @ predicate scheduler_apart(keel_scheduler_t *s) =
  @     (\forall integer i; 0 <= i < s->queue.count ==> \separated(s, s->queue.task[i])) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         \base_addr(s) != \base_addr(s->queue.task[i]->config));
  @
  @ // ... from each other ...
  @ predicate tasks_apart(keel_scheduler_t *s) =
  @     \forall integer i, j; 0 <= i < s->queue.count ==> 0 <= j < s->queue.count ==> i != j ==>
  @         \separated(s->queue.task[i], s->queue.task[j]);
  @
  @ // ... and no declaration, which tasks may share, lies in an object with a task.
  @ predicate configs_apart(keel_scheduler_t *s) =
  @     \forall integer i, j; 0 <= i < s->queue.count ==> 0 <= j < s->queue.count ==>
  @         \base_addr(s->queue.task[i]) != \base_addr(s->queue.task[j]->config);
  @
  @ predicate scheduler_valid(keel_scheduler_t *s) =
  @     queue_counts(&s->queue) && queue_no_gaps(&s->queue) && queue_no_duplicates(&s->queue) &&
  @     queue_tasks_valid(&s->queue) && queue_configs_valid(&s->queue) &&
  @     queue_realtime_first(&s->queue) && queue_others_last(&s->queue) &&
  @     queue_checked(&s->queue) && scheduler_apart(s) && tasks_apart(s) && configs_apart(s) &&
  @     scheduler_state(s);
  @
  @ // Until the start no time has passed, and every task waits for its phase.
  @ predicate setup_armed(keel_scheduler_t *s) =
  @     s->stage == KEEL_STAGE_SETUP ==> s->clock.now_us == 0 &&
  @         \forall integer i; 0 <= i < s->queue.count ==>
  @             s->queue.task[i]->release_us == s->queue.task[i]->config->phase_us;
  @
  @ // The theorems hold up to this uptime; beyond it the kernel is not proved.
  @ predicate in_uptime(keel_scheduler_t *s) = s->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @
  @ // A task that the scheduler does not hold yet, in memory of its own.
  @ predicate task_apart(keel_scheduler_t *s, keel_task_t *task) =
  @     \separated(s, task) && \base_addr(s) != \base_addr(task->config) &&
  @     \base_addr(task) != \base_addr(task->config) &&
  @     (\forall integer i; 0 <= i < s->queue.count && s->queue.task[i] != task ==>
  @         \separated(s->queue.task[i], task)) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         \base_addr(s->queue.task[i]) != \base_addr(task->config)) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         \base_addr(task) != \base_addr(s->queue.task[i]->config));
  @
  @ // Whether a task fits the time to every real-time release: W + w <= S.
  @ predicate fits_slack(keel_scheduler_t *s, keel_task_t *task, integer now_us) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         s->config.guard_us + task_worst(task) <= time_to(s->queue.task[j], now_us);
  @
  @ // Whether a task runs if the scheduler decides at now_us and no real-time task is due.
  @ predicate may_run(keel_scheduler_t *s, keel_task_t *task, integer now_us) =
  @     released(task, now_us) && (promoted(task, now_us) || fits_slack(s, task, now_us));
  @
  @ // Nothing is due at now_us: neither a real-time task, nor another that may run.
  @ predicate nothing_due(keel_scheduler_t *s, integer now_us) =
  @     (\forall integer i; 0 <= i < s->queue.realtime_count ==>
  @         !released(s->queue.task[i], now_us)) &&
  @     (\forall integer i; s->queue.realtime_count <= i < s->queue.count ==>
  @         !may_run(s, s->queue.task[i], now_us));
  @
  @ // Why a task that is not real-time cannot run before wake_us: it is not released before, or it
  @ // does not fit the slack, which only shrinks, and is not promoted before.
  @ predicate waits(keel_scheduler_t *s, keel_task_t *task) =
  @     s->wake_us <= task->release_us ||
  @     (s->wake_us <= task->release_us - task->config->period_us
  @                    + promotion_age(task->config->priority, task->config->period_us) &&
  @      !fits_slack(s, task, s->clock.now_us));
  @
  @ // The claim that wake_us makes while it lies ahead: nothing is due before it.
  @ predicate wake_realtime(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < s->queue.realtime_count ==>
  @         s->wake_us <= s->queue.task[i]->release_us;
  @
  @ predicate wake_others(keel_scheduler_t *s) =
  @     \forall integer i; s->queue.realtime_count <= i < s->queue.count ==>
  @         waits(s, s->queue.task[i]);
  @
  @ predicate wake_right(keel_scheduler_t *s) =
  @     s->clock.now_us < s->wake_us ==> wake_realtime(s) && wake_others(s);
  @
  @ // The longest run of task k, unchanged.
  @ predicate longest_same{L, M}(keel_scheduler_t *s, integer k) =
  @     \at(s->queue.task[k]->stats.longest_us, M) == \at(s->queue.task[k]->stats.longest_us, L);
  @
  @ // The release of task k, unchanged.
  @ predicate release_same{L, M}(keel_scheduler_t *s, integer k) =
  @     \at(s->queue.task[k]->release_us, M) == \at(s->queue.task[k]->release_us, L);
  @*/

/*@ // What scheduling reads of the declarations, unchanged by writing tasks and the scheduler. One
  @ // predicate to a field, as provers frame one field at a time.
  @ predicate config_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config, M) ==
  @             \at(s->queue.task[i]->config, L);
  @
  @ predicate priority_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config->priority, M) ==
  @             \at(s->queue.task[i]->config->priority, L);
  @
  @ predicate period_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config->period_us, M) ==
  @             \at(s->queue.task[i]->config->period_us, L);
  @
  @ predicate budget_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config->budget_us, M) ==
  @             \at(s->queue.task[i]->config->budget_us, L);
  @
  @ predicate phase_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config->phase_us, M) ==
  @             \at(s->queue.task[i]->config->phase_us, L);
  @
  @ predicate run_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(s->queue.task[i]->config->run, M) ==
  @             \at(s->queue.task[i]->config->run, L);
  @
  @ predicate all_longest_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==> longest_same{L, M}(s, i);
  @
  @ predicate worst_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(task_worst(s->queue.task[i]), M) == \at(task_worst(s->queue.task[i]), L);
  @
  @ predicate promotion_same{L, M}(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < \at(s->queue.count, L) ==>
  @         \at(promotion_age(s->queue.task[i]->config->priority,
  @                           s->queue.task[i]->config->period_us), M) ==
  @         \at(promotion_age(s->queue.task[i]->config->priority,
  @                           s->queue.task[i]->config->period_us), L);
  @*/

/* The scheduler that is running: any one. Nothing assigns it; it exists in proofs alone. */
//@ ghost extern keel_scheduler_t *running_scheduler;

/*
 * What is assumed of the functions that the user supplies, as contracts of two that stand for any.
 * They are declared for the proofs alone; nobody defines or calls them.
 */
/* Any clock: it writes nothing that the kernel reads. */
/*@ assigns \nothing; */
uint32_t keel_any_clock(void *context);

/*@ predicate clock_modelled(keel_scheduler_t *s) = s->config.read_clock == &keel_any_clock;
  @
  @ // The room for a pass' readings of the clock below the uptime's limit: one opens the pass, one
  @ // follows each real-time task that is left and one the last task.
  @ predicate uptime_left(keel_scheduler_t *s, integer readings) =
  @     s->clock.now_us + readings * KEEL_CLOCK_STEP_LIMIT_US <= KEEL_CLOCK_TIME_LIMIT_US;
  @*/

/* Any body: it may write all memory, but of the scheduler only through keel_scheduler_add and
 * keel_scheduler_remove, which keep these. */
/*@ requires \valid(running_scheduler) && scheduler_valid(running_scheduler);
  @ requires in_uptime(running_scheduler) && stage_running(running_scheduler);
  @ assigns *running_scheduler, { *task | keel_task_t *task; \true };
  @ SCHEDULER_STAYS_VALID(running_scheduler)
  @ ensures stage: running_scheduler->stage == \old(running_scheduler->stage);
  @ ensures now: running_scheduler->clock.now_us == \old(running_scheduler->clock.now_us);
  @ ensures busy: running_scheduler->busy_us == \old(running_scheduler->busy_us);
  @ ensures pass: running_scheduler->pass_end - running_scheduler->cursor <=
  @     \old(running_scheduler->pass_end - running_scheduler->cursor);
  @ ensures clock: running_scheduler->config.read_clock ==
  @     \old(running_scheduler->config.read_clock);
  @ ensures bodies: \forall integer i; 0 <= i < running_scheduler->queue.count ==>
  @     running_scheduler->queue.task[i]->config->run == &keel_any_body;
  @*/
void keel_any_body(void *context);

/*@ predicate bodies_modelled(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < s->queue.count ==>
  @         s->queue.task[i]->config->run == &keel_any_body;
  @*/

/**
 * Prepares a scheduler without tasks (requirement SCH-001).
 *
 * @param scheduler the scheduler to initialise
 * @param config    how; it is copied
 * @return KEEL_OK; KEEL_ERR_NULL for a null argument or a null clock; KEEL_ERR_CONFIG when the
 *         guard is 2^31 us or more or the utilisation limit above KEEL_UTILISATION_FULL_PPM
 */
/*@ requires scheduler == \null || \valid(scheduler);
  @ requires config == \null || \valid_read(config);
  @ requires scheduler != \null && config != \null ==> \separated(scheduler, config);
  @ behavior null:
  @   assumes scheduler == \null || config == \null || config->read_clock == \null;
  @   assigns \nothing;
  @   ensures SCH_002_null: \result == KEEL_ERR_NULL;
  @ behavior config:
  @   assumes scheduler != \null && config != \null && config->read_clock != \null;
  @   assumes config->guard_us >= KEEL_PERIOD_LIMIT_US ||
  @       config->utilisation_limit > KEEL_UTILISATION_FULL_PPM;
  @   assigns \nothing;
  @   ensures SCH_002_config: \result == KEEL_ERR_CONFIG;
  @ behavior done:
  @   assumes scheduler != \null && config != \null && config->read_clock != \null;
  @   assumes config->guard_us < KEEL_PERIOD_LIMIT_US &&
  @       config->utilisation_limit <= KEEL_UTILISATION_FULL_PPM;
  @   assigns *scheduler;
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_001_valid: scheduler_valid(scheduler);
  @   ensures SCH_009_waiting: setup_armed(scheduler);
  @   ensures SCH_001_empty: scheduler->queue.count == 0 && scheduler->clock.now_us == 0 &&
  @       scheduler->busy_us == 0;
  @   ensures SCH_001_config: scheduler->config.guard_us == config->guard_us &&
  @       scheduler->config.utilisation_limit == config->utilisation_limit &&
  @       scheduler->config.read_clock == config->read_clock &&
  @       scheduler->config.clock_context == config->clock_context;
  @   ensures SCH_001_stage: scheduler->stage == KEEL_STAGE_SETUP && scheduler->wake_us == 0 &&
  @       scheduler->cursor == 0 && scheduler->pass_end == 0 &&
  @       scheduler->running == KEEL_INDEX_NONE;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config);

/**
 * Checks whether the tasks can be scheduled, and names the first that cannot (requirement
 * SCH-003). Changes nothing.
 *
 * @param scheduler the scheduler
 * @param admitted  receives how many tasks are admitted: on refusal, the offender is
 *                  scheduler->queue.task[*admitted]
 * @return KEEL_OK, or the offender's KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP or
 *         KEEL_ERR_UTILISATION
 */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(admitted) && \separated(admitted, scheduler);
  @ requires \forall integer i; 0 <= i < scheduler->queue.count ==>
  @     \separated(admitted, scheduler->queue.task[i]);
  @ requires \forall integer i; 0 <= i < scheduler->queue.count ==>
  @     \separated(admitted, scheduler->queue.task[i]->config);
  @ assigns *admitted;
  @ ensures SCH_003_all: \result == KEEL_OK <==> *admitted == scheduler->queue.count;
  @ ensures SCH_003_offender: *admitted <= scheduler->queue.count;
  @ ensures SCH_003_demand: \result == KEEL_OK ==>
  @     \old(demand_admitted(&scheduler->queue, scheduler->config.guard_us));
  @ ensures SCH_003_gaps: \result == KEEL_OK ==>
  @     \old(gaps_admitted(&scheduler->queue, scheduler->config.guard_us));
  @*/
keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted);

/**
 * Adds a task (requirement SCH-004). Before the start it is only checked by itself; afterwards it
 * is also admitted with the rest of the set, and its first release is its phase from now. It may
 * be called from inside a running task; the new task waits for the next pass.
 *
 * @param scheduler the scheduler
 * @param task      the task, with its declaration set; both must outlive their stay
 * @return KEEL_OK; KEEL_ERR_NULL, or what keel_task_check says; KEEL_ERR_DUPLICATE;
 *         KEEL_ERR_FULL; after the start what keel_admission_admit says; in this order
 */
/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler));
  @ requires scheduler != \null ==> in_uptime(scheduler);
  @ requires task == \null || \valid(task);
  @ requires task != \null ==> task->config == \null || \valid_read(task->config);
  @ requires scheduler != \null && task != \null ==> task_apart(scheduler, task);
  @ assigns scheduler->queue, scheduler->wake_us, scheduler->running;
  @ assigns task->skipped, task->release_us, task->stats;
  @ ensures SCH_005_null: scheduler == \null || task == \null ==> \result == KEEL_ERR_NULL;
  @ ensures SCH_005_checked: \result == KEEL_OK ==> config_valid(task->config);
  @ ensures SCH_005_duplicate: scheduler != \null && task != \null &&
  @     \old(queue_holds(&scheduler->queue, task)) ==> \result != KEEL_OK;
  @ ensures SCH_006_valid: scheduler != \null ==> scheduler_valid(scheduler);
  @ ensures SCH_009_waiting: scheduler != \null && \old(setup_armed(scheduler)) ==>
  @     setup_armed(scheduler);
  @ ensures SCH_004_count: \result == KEEL_OK ==>
  @     scheduler->queue.count == \old(scheduler->queue.count) + 1;
  @ ensures SCH_004_armed: \result == KEEL_OK ==>
  @     task->release_us == \old(scheduler->clock.now_us) + task->config->phase_us &&
  @     task->skipped == 0 && stats_fresh(task->stats);
  @ ensures SCH_004_wake: \result == KEEL_OK ==> scheduler->wake_us == 0;
  @ ensures SCH_004_periods: \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(periods_hold_with(&scheduler->queue, task->config, scheduler->config.guard_us));
  @ ensures SCH_004_period: \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(period_holds_all(&scheduler->queue, task->config, scheduler->config.guard_us));
  @ ensures SCH_004_gaps: \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(gaps_admitted(&scheduler->queue, scheduler->config.guard_us));
  @ ensures SCH_004_fits: \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(fits_gaps(&scheduler->queue, task->config, scheduler->config.guard_us));
  @ ensures SCH_004_leaves: \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(leaves_gaps(&scheduler->queue, task->config, scheduler->config.guard_us));
  @ ensures SCH_004_utilisation:
  @     \result == KEEL_OK && \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \old(total_utilisation(&scheduler->queue, scheduler->queue.count) +
  @          utilisation(task->config)) <= scheduler->config.utilisation_limit;
  @ ensures SCH_006_stage: scheduler != \null ==> scheduler->stage == \old(scheduler->stage);
  @ ensures SCH_006_now: scheduler != \null ==>
  @     scheduler->clock.now_us == \old(scheduler->clock.now_us);
  @ ensures SCH_006_busy: scheduler != \null ==>
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @ ensures SCH_006_clock: scheduler != \null ==>
  @     scheduler->config.read_clock == \old(scheduler->config.read_clock);
  @ ensures SCH_006_pass: scheduler != \null ==>
  @     scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->cursor == \old(scheduler->cursor);
  @ ensures SCH_006_running: \result == KEEL_OK && \old(scheduler->running) != KEEL_INDEX_NONE ==>
  @     scheduler->queue.task[scheduler->running] ==
  @         \old(scheduler->queue.task[scheduler->running]);
  @*/
keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, keel_task_t *task);

/**
 * Removes a task (requirement SCH-007). It may be called from inside a running task, also for the
 * running task itself; no task is then skipped or run twice in the pass.
 *
 * @param scheduler the scheduler
 * @param task      the task to remove
 * @return KEEL_OK, KEEL_ERR_NULL, or KEEL_ERR_UNKNOWN_TASK when it is not in the queue
 */
/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler));
  @ assigns scheduler->queue, scheduler->wake_us, scheduler->cursor, scheduler->pass_end,
  @     scheduler->running;
  @ ensures SCH_008_null: scheduler == \null || task == \null ==> \result == KEEL_ERR_NULL;
  @ ensures SCH_008_unknown: scheduler != \null && task != \null &&
  @     \old(!queue_holds(&scheduler->queue, task)) ==> \result == KEEL_ERR_UNKNOWN_TASK;
  @ ensures SCH_006_valid: scheduler != \null ==> scheduler_valid(scheduler);
  @ ensures SCH_009_waiting: scheduler != \null && \old(setup_armed(scheduler)) ==>
  @     setup_armed(scheduler);
  @ ensures SCH_007_gone: \result == KEEL_OK ==> !queue_holds(&scheduler->queue, task);
  @ ensures SCH_007_count: \result == KEEL_OK ==>
  @     scheduler->queue.count == \old(scheduler->queue.count) - 1;
  @ ensures SCH_007_wake: \result == KEEL_OK ==> scheduler->wake_us == 0;
  @ ensures SCH_006_stage: scheduler != \null ==> scheduler->stage == \old(scheduler->stage);
  @ ensures SCH_006_now: scheduler != \null ==>
  @     scheduler->clock.now_us == \old(scheduler->clock.now_us);
  @ ensures SCH_006_busy: scheduler != \null ==>
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @ ensures SCH_006_clock: scheduler != \null ==>
  @     scheduler->config.read_clock == \old(scheduler->config.read_clock);
  @ ensures SCH_006_pass: scheduler != \null ==> scheduler->pass_end - scheduler->cursor <=
  @     \old(scheduler->pass_end - scheduler->cursor);
  @ ensures SCH_006_cursor: \result == KEEL_OK &&
  @     0 <= \old(scheduler->cursor) < \old(scheduler->pass_end) &&
  @     \old(scheduler->queue.task[scheduler->cursor]) != task ==>
  @     scheduler->queue.task[scheduler->cursor] ==
  @         \old(scheduler->queue.task[scheduler->cursor]);
  @ ensures SCH_006_running: \result == KEEL_OK && \old(scheduler->running) != KEEL_INDEX_NONE &&
  @     \old(scheduler->queue.task[scheduler->running]) != task ==>
  @     scheduler->queue.task[scheduler->running] ==
  @         \old(scheduler->queue.task[scheduler->running]);
  @ ensures SCH_006_forgotten: \result == KEEL_OK &&
  @     \old(scheduler->running) != KEEL_INDEX_NONE &&
  @     \old(scheduler->queue.task[scheduler->running]) == task ==>
  @     scheduler->running == KEEL_INDEX_NONE;
  @*/
keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, keel_task_t *task);

/**
 * Starts the scheduler with a given reading of the clock: time begins at 0, and every task's first
 * release is its phase (requirement SCH-009).
 *
 * @param scheduler a scheduler that was not started yet
 * @param raw_us    the clock now
 * @return KEEL_OK; KEEL_ERR_STATE when it was started before; what keel_scheduler_check says
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && setup_armed(scheduler);
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->stage;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_010_state: \old(scheduler->stage) != KEEL_STAGE_SETUP ==>
  @     \result == KEEL_ERR_STATE;
  @ ensures SCH_010_kept: \result != KEEL_OK ==>
  @     scheduler->stage == \old(scheduler->stage) &&
  @     scheduler->clock.now_us == \old(scheduler->clock.now_us);
  @ ensures SCH_009_stage: \result == KEEL_OK ==> scheduler->stage == KEEL_STAGE_READY;
  @ ensures SCH_009_clock: \result == KEEL_OK ==>
  @     scheduler->clock.now_us == 0 && scheduler->clock.raw_us == raw_us;
  @ ensures SCH_009_release: \result == KEEL_OK ==>
  @     \forall integer i; 0 <= i < scheduler->queue.count ==>
  @         scheduler->queue.task[i]->release_us == scheduler->queue.task[i]->config->phase_us;
  @ ensures SCH_009_admitted: \result == KEEL_OK ==>
  @     \old(demand_admitted(&scheduler->queue, scheduler->config.guard_us)) &&
  @     \old(gaps_admitted(&scheduler->queue, scheduler->config.guard_us));
  @*/
keel_status_t keel_scheduler_start_at(keel_scheduler_t *scheduler, uint32_t raw_us);

/**
 * Begins a step: takes the time, and opens a pass unless nothing can be due (requirement SCH-011).
 *
 * @param scheduler a started scheduler
 * @param raw_us    the clock now, at most 2^31 - 1 us after its last reading
 * @return KEEL_OK; KEEL_ERR_STATE when it is not started, or a pass is open; KEEL_ERR_CLOCK when
 *         the clock jumped backwards
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires wake_right(scheduler);
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->wake_us, scheduler->stage,
  @     scheduler->cursor, scheduler->pass_end, scheduler->ran;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ DECLARATIONS_STAY(scheduler)
  @ ensures SCH_011_releases: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @     release_same{Pre, Post}(scheduler, k);
  @ ensures SCH_012_wake: wake_right(scheduler);
  @ behavior state:
  @   assumes scheduler->stage != KEEL_STAGE_READY;
  @   assigns \nothing;
  @   ensures SCH_013_state: \result == KEEL_ERR_STATE;
  @   ensures SCH_013_same: scheduler->stage == \old(scheduler->stage) &&
  @       scheduler->cursor == \old(scheduler->cursor) &&
  @       scheduler->pass_end == \old(scheduler->pass_end) &&
  @       scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->clock.raw_us == \old(scheduler->clock.raw_us);
  @ behavior backwards:
  @   assumes scheduler->stage == KEEL_STAGE_READY;
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) >= KEEL_CLOCK_STEP_LIMIT_US;
  @   assigns scheduler->clock.now_us, scheduler->clock.raw_us;
  @   ensures SCH_013_clock: \result == KEEL_ERR_CLOCK;
  @   ensures SCH_013_kept: scheduler->stage == KEEL_STAGE_READY &&
  @       scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->clock.raw_us == \old(scheduler->clock.raw_us);
  @ behavior forwards:
  @   assumes scheduler->stage == KEEL_STAGE_READY;
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) < KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_011_time: scheduler->clock.now_us == \old(scheduler->clock.now_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_011_raw: scheduler->clock.raw_us == raw_us;
  @   ensures SCH_011_idle: scheduler->stage == KEEL_STAGE_READY ==>
  @       nothing_due(scheduler, scheduler->clock.now_us);
  @   ensures SCH_011_open: scheduler->stage == KEEL_STAGE_READY ||
  @       (scheduler->stage == KEEL_STAGE_PASS && scheduler->cursor == 0 &&
  @        scheduler->pass_end == scheduler->queue.realtime_count && !scheduler->ran);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_begin(keel_scheduler_t *scheduler, uint32_t raw_us);

/**
 * Decides which task runs now and takes it into service: its release moves on along its grid
 * (requirements SCH-014 to SCH-016).
 *
 * @param scheduler a scheduler
 * @return the task, whose body the caller must run now and then call keel_scheduler_finish; null
 *         when the pass is over, or none is open
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires wake_right(scheduler);
  @ assigns scheduler->wake_us, scheduler->stage, scheduler->cursor, scheduler->running,
  @     scheduler->ran;
  @ assigns scheduler->queue.task[0 .. scheduler->queue.count - 1]->skipped;
  @ assigns scheduler->queue.task[0 .. scheduler->queue.count - 1]->release_us;
  @ assigns scheduler->queue.task[0 .. scheduler->queue.count - 1]->stats.promotions;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ DECLARATIONS_STAY(scheduler)
  @ ensures SCH_014_pass: scheduler->pass_end == \old(scheduler->pass_end);
  @ ensures SCH_014_time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @ behavior closed:
  @   assumes scheduler->stage != KEEL_STAGE_PASS;
  @   ensures SCH_014_closed: \result == \null && scheduler->stage == \old(scheduler->stage);
  @ behavior open:
  @   assumes scheduler->stage == KEEL_STAGE_PASS;
  @   ensures SCH_014_stage: (\result == \null && scheduler->stage == KEEL_STAGE_READY) ||
  @       (\result != \null && stage_running(scheduler));
  @   ensures SCH_014_task: \result != \null ==>
  @       scheduler->running < scheduler->queue.count &&
  @       \result == scheduler->queue.task[scheduler->running];
  @   ensures SCH_014_released: \result != \null ==>
  @       \at(\result->release_us, Pre) <= scheduler->clock.now_us;
  @   ensures SCH_014_release: \result != \null ==>
  @       scheduler->clock.now_us < \result->release_us;
  @   ensures SCH_014_on_time: \result != \null ==>
  @       scheduler->clock.now_us < \at(\result->release_us, Pre) + \result->config->period_us ==>
  @       \result->release_us == \at(\result->release_us, Pre) + \result->config->period_us;
  @   ensures SCH_014_others: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @       scheduler->queue.task[k] != \result ==> release_same{Pre, Post}(scheduler, k);
  @   ensures SCH_015_realtime: scheduler->stage == KEEL_STAGE_REALTIME ==>
  @       \old(scheduler->cursor) <= scheduler->running < scheduler->pass_end &&
  @       scheduler->cursor == scheduler->running + 1;
  @   ensures SCH_015_first: scheduler->stage == KEEL_STAGE_REALTIME ==>
  @       \forall integer i; \old(scheduler->cursor) <= i < scheduler->running ==>
  @           !\old(released(scheduler->queue.task[i], scheduler->clock.now_us));
  @   ensures SCH_015_none: scheduler->stage != KEEL_STAGE_REALTIME ==>
  @       scheduler->cursor == scheduler->pass_end &&
  @       \forall integer i; \old(scheduler->cursor) <= i < scheduler->pass_end ==>
  @           !\old(released(scheduler->queue.task[i], scheduler->clock.now_us));
  @   ensures SCH_016_class: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       scheduler->running >= scheduler->queue.realtime_count;
  @   ensures SCH_016_fits: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \old(may_run(scheduler, \result, scheduler->clock.now_us));
  @   ensures SCH_016_highest: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @           \old(may_run(scheduler, scheduler->queue.task[i], scheduler->clock.now_us)) ==>
  @           \old(task_priority(scheduler->queue.task[i], scheduler->clock.now_us)) <=
  @               \at(task_priority(\result, scheduler->clock.now_us), Pre);
  @   ensures SCH_016_first: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->running ==>
  @           \old(may_run(scheduler, scheduler->queue.task[i], scheduler->clock.now_us)) ==>
  @           \old(task_priority(scheduler->queue.task[i], scheduler->clock.now_us)) <
  @               \at(task_priority(\result, scheduler->clock.now_us), Pre);
  @   ensures SCH_016_none: \result == \null ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @           !\old(may_run(scheduler, scheduler->queue.task[i], scheduler->clock.now_us));
  @   ensures SCH_012_wake: wake_right(scheduler);
  @   ensures SCH_012_bound: \result == \null && !\old(scheduler->ran) ==>
  @       \forall integer i; 0 <= i < scheduler->queue.count ==> scheduler->wake_us <=
  @           next_event(scheduler->queue.task[i], scheduler->clock.now_us);
  @   ensures SCH_012_exact: \result == \null && !\old(scheduler->ran) ==>
  @       scheduler->wake_us == KEEL_TIME_NEVER_US ||
  @       (\exists integer i; 0 <= i < scheduler->queue.count && scheduler->wake_us ==
  @           next_event(scheduler->queue.task[i], scheduler->clock.now_us));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_task_t *keel_scheduler_next(keel_scheduler_t *scheduler);

/**
 * Finishes the running task: takes the time, and records how long it ran (requirement SCH-017).
 * When the clock jumped backwards nothing is recorded, and the pass ends.
 *
 * @param scheduler a scheduler whose keel_scheduler_next has returned a task
 * @param raw_us    the clock now, at most 2^31 - 1 us after its last reading
 * @return KEEL_OK; KEEL_ERR_STATE when no task runs; KEEL_ERR_CLOCK
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->busy_us <= scheduler->clock.now_us;
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->busy_us, scheduler->stage,
  @     scheduler->running, STATS_FIELDS(scheduler->queue.task[scheduler->running]->stats);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ DECLARATIONS_STAY(scheduler)
  @ ensures SCH_017_releases: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @     release_same{Pre, Post}(scheduler, k);
  @ ensures SCH_017_pass: scheduler->cursor == \old(scheduler->cursor) &&
  @     scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->wake_us == \old(scheduler->wake_us);
  @ ensures SCH_017_busy_bound: scheduler->busy_us <= scheduler->clock.now_us;
  @ behavior state:
  @   assumes !stage_running(scheduler);
  @   ensures SCH_018_state: \result == KEEL_ERR_STATE;
  @   ensures SCH_018_kept: scheduler->stage == \old(scheduler->stage) &&
  @       scheduler->running == \old(scheduler->running) &&
  @       scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->clock.raw_us == \old(scheduler->clock.raw_us) &&
  @       scheduler->busy_us == \old(scheduler->busy_us);
  @ behavior backwards:
  @   assumes stage_running(scheduler);
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) >= KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures SCH_018_clock: \result == KEEL_ERR_CLOCK;
  @   ensures SCH_018_time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->busy_us == \old(scheduler->busy_us);
  @   ensures SCH_018_ends: scheduler->stage == KEEL_STAGE_READY &&
  @       scheduler->running == KEEL_INDEX_NONE;
  @ behavior forwards:
  @   assumes stage_running(scheduler);
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) < KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_017_time: scheduler->clock.now_us == \old(scheduler->clock.now_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_017_raw: scheduler->clock.raw_us == raw_us;
  @   ensures SCH_017_busy: scheduler->busy_us == \old(scheduler->busy_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_017_stage: scheduler->stage ==
  @       ((\old(scheduler->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @   ensures SCH_017_running: scheduler->running == KEEL_INDEX_NONE;
  @   ensures SCH_017_recorded: \old(scheduler->running) != KEEL_INDEX_NONE ==>
  @       scheduler->queue.task[\old(scheduler->running)]->stats.last_us ==
  @           clock_elapsed(\old(scheduler->clock.raw_us), raw_us) &&
  @       scheduler->queue.task[\old(scheduler->running)]->stats.longest_us == \max(
  @           \old(scheduler->queue.task[scheduler->running]->stats.longest_us),
  @           clock_elapsed(\old(scheduler->clock.raw_us), raw_us));
  @   ensures SCH_017_others: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @       k != \old(scheduler->running) ==> longest_same{Pre, Post}(scheduler, k);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_finish(keel_scheduler_t *scheduler, uint32_t raw_us);

/**
 * Reads the clock and starts the scheduler (keel_scheduler_start_at, requirement SCH-019).
 *
 * @param scheduler the scheduler, or null
 * @return KEEL_ERR_NULL, or what keel_scheduler_start_at says
 */
/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     setup_armed(scheduler) && clock_modelled(scheduler));
  @ behavior null:
  @   assumes scheduler == \null;
  @   assigns \nothing;
  @   ensures SCH_019_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_SETUP;
  @   assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->stage;
  @   ensures SCH_019_state: \result == KEEL_ERR_STATE;
  @ behavior setup:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_SETUP;
  @   assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->stage;
  @   ensures SCH_019_valid: scheduler_valid(scheduler);
  @   ensures SCH_019_started: \result == KEEL_OK <==> scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_019_admitted: \result == KEEL_OK ==>
  @       \old(demand_admitted(&scheduler->queue, scheduler->config.guard_us)) &&
  @       \old(gaps_admitted(&scheduler->queue, scheduler->config.guard_us));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler);

/**
 * Runs the pass that keel_scheduler_begin has opened to its end (requirement SCH-023): next, the
 * body and finish in turn. Does nothing when none is open.
 *
 * @param scheduler a started scheduler, not from within a task
 * @return KEEL_OK, or KEEL_ERR_CLOCK when the clock jumped backwards: see keel_scheduler_resync
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler == running_scheduler && clock_modelled(scheduler) &&
  @     bodies_modelled(scheduler);
  @ requires wake_right(scheduler) && scheduler->busy_us <= scheduler->clock.now_us;
  @ requires scheduler->stage == KEEL_STAGE_READY || scheduler->stage == KEEL_STAGE_PASS;
  @ requires scheduler->stage == KEEL_STAGE_PASS ==>
  @     uptime_left(scheduler, scheduler->pass_end - scheduler->cursor + 1);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_023_wake: wake_right(scheduler);
  @ ensures SCH_023_result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @ ensures SCH_023_closed: scheduler->stage == KEEL_STAGE_READY;
  @ ensures SCH_023_time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us;
  @ ensures SCH_023_busy: scheduler->busy_us <= scheduler->clock.now_us;
  @*/
keel_status_t keel_scheduler_run_pass(keel_scheduler_t *scheduler);

/**
 * One step: a pass over the tasks, if any can be due (requirement SCH-020). To be called for ever,
 * at most 2^31 us apart; for the isolation theorem (specs/soundness.md) at most W apart.
 *
 * @param scheduler a started scheduler, or null
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE before the start and from within a task;
 *         KEEL_ERR_CLOCK when the clock jumped backwards: see keel_scheduler_resync
 */
/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     scheduler == running_scheduler && clock_modelled(scheduler) && bodies_modelled(scheduler));
  @ requires scheduler != \null ==> wake_right(scheduler) &&
  @     uptime_left(scheduler, scheduler->queue.realtime_count + 2) &&
  @     scheduler->busy_us <= scheduler->clock.now_us;
  @ behavior null:
  @   assumes scheduler == \null;
  @   ensures SCH_020_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_READY;
  @   ensures SCH_020_state: \result == KEEL_ERR_STATE;
  @   ensures SCH_020_kept: scheduler->stage == \old(scheduler->stage) &&
  @       scheduler->cursor == \old(scheduler->cursor) &&
  @       scheduler->pass_end == \old(scheduler->pass_end) &&
  @       scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->clock.raw_us == \old(scheduler->clock.raw_us);
  @ behavior ready:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_READY;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SCH_020_wake: wake_right(scheduler);
  @   ensures SCH_020_result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @   ensures SCH_020_closed: scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_020_time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us;
  @   ensures SCH_020_busy: scheduler->busy_us <= scheduler->clock.now_us;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler);

/**
 * Takes up a clock that has jumped: time goes on from its reading, as if none had passed
 * (requirement SCH-021).
 *
 * @param scheduler a scheduler between two steps, or null
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE before the start and from within a task
 */
/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     clock_modelled(scheduler));
  @ behavior null:
  @   assumes scheduler == \null;
  @   assigns \nothing;
  @   ensures SCH_021_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_READY;
  @   assigns \nothing;
  @   ensures SCH_021_state: \result == KEEL_ERR_STATE;
  @ behavior ready:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_READY;
  @   assigns scheduler->clock.raw_us;
  @   ensures SCH_021_taken: \result == KEEL_OK;
  @   ensures SCH_021_valid: scheduler_valid(scheduler);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler);

#endif
