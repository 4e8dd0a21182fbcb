/**
 * @file admission.h
 * @brief Whether a set of tasks can be scheduled: checked before flight, one task at a time.
 *
 * The totals of a set are gathered task by task; the first task with which the set breaks a rule
 * is refused, and so can be named. Adding tasks never mends a broken rule, so a set is admitted
 * exactly when each task in turn is. The rules, with W the scheduler's guard, C and T a task's
 * budget and period:
 *
 *     real-time demand   sum of all real-time C + 2 W <= T   for every real-time task
 *     gap                C + W <= T_rt - C_rt                for every other task, every real-time
 *     utilisation        sum of C / T <= limit               over all tasks (eq. 8, 11)
 *
 * The first is what the isolation theorem needs (specs/soundness.md). The second: a real-time
 * task leaves a gap of at most T - C between its runs, and a budget that exceeds it never fits.
 */
#ifndef KEEL_RTOS_ADMISSION_H
#define KEEL_RTOS_ADMISSION_H

#include "keel/rtos/queue.h"
#include "keel/rtos/task.h"
#include "keel/status.h"

#include <stdint.h>

/** A utilisation of 100 %, in parts per million. */
#define KEEL_UTILISATION_FULL_PPM 1000000u

/** The totals of the tasks admitted so far, with the limits they are held to. */
typedef struct keel_admission {
    uint64_t guard_us;             /**< W, the guard, below 2^31 us. */
    uint64_t utilisation_limit;    /**< The highest utilisation, in ppm. */
    uint64_t utilisation;          /**< Sum of C / T, each rounded up, in ppm. */
    uint64_t realtime_demand_us;   /**< Sum of the real-time budgets, in us. */
    uint64_t shortest_realtime_us; /**< Shortest real-time period, in us; UINT64_MAX if none. */
    uint64_t shortest_gap_us;      /**< Shortest T - C of a real-time task; UINT64_MAX if none. */
    uint64_t longest_other_us;     /**< Longest budget of another task, in us. */
    uint64_t tasks;                /**< How many tasks were admitted. */
} keel_admission_t;

/*@ // C / T in parts per million, rounded up.
  @ logic integer utilisation(keel_task_config_t *c) =
  @     (c->budget_us * KEEL_UTILISATION_FULL_PPM + c->period_us - 1) / c->period_us;
  @
  @ logic integer realtime_budget(keel_task_config_t *c) =
  @     (c->priority == KEEL_PRIORITY_REALTIME) ? c->budget_us : 0;
  @
  @ predicate admission_demand(keel_admission_t a) =
  @     a.realtime_demand_us == 0 ||
  @     a.realtime_demand_us + 2 * a.guard_us <= a.shortest_realtime_us;
  @
  @ predicate admission_gap(keel_admission_t a) =
  @     a.longest_other_us == 0 || a.longest_other_us + a.guard_us <= a.shortest_gap_us;
  @
  @ predicate admission_utilisation(keel_admission_t a) = a.utilisation <= a.utilisation_limit;
  @
  @ predicate admissible(keel_admission_t a) =
  @     admission_demand(a) && admission_gap(a) && admission_utilisation(a);
  @
  @ // Totals that cannot overflow: the limits are in range and the demand is below a period.
  @ predicate admission_valid(keel_admission_t a) =
  @     a.guard_us < KEEL_PERIOD_LIMIT_US && a.utilisation_limit <= KEEL_UTILISATION_FULL_PPM &&
  @     a.realtime_demand_us < KEEL_PERIOD_LIMIT_US &&
  @     a.longest_other_us <= UINT32_MAX && a.tasks <= KEEL_QUEUE_CAPACITY && admissible(a);
  @
  @ // What the totals become with one more task.
  @ logic integer with_demand(keel_admission_t a, keel_task_config_t *c) =
  @     a.realtime_demand_us + realtime_budget(c);
  @
  @ logic integer with_period(keel_admission_t a, keel_task_config_t *c) =
  @     (c->priority == KEEL_PRIORITY_REALTIME)
  @         ? \min(a.shortest_realtime_us, c->period_us) : a.shortest_realtime_us;
  @
  @ logic integer with_gap(keel_admission_t a, keel_task_config_t *c) =
  @     (c->priority == KEEL_PRIORITY_REALTIME)
  @         ? \min(a.shortest_gap_us, \max(0, c->period_us - c->budget_us)) : a.shortest_gap_us;
  @
  @ logic integer with_other(keel_admission_t a, keel_task_config_t *c) =
  @     (c->priority == KEEL_PRIORITY_REALTIME)
  @         ? a.longest_other_us : \max(a.longest_other_us, c->budget_us);
  @
  @ predicate demand_fits(keel_admission_t a, keel_task_config_t *c) =
  @     with_demand(a, c) == 0 || with_demand(a, c) + 2 * a.guard_us <= with_period(a, c);
  @
  @ predicate gap_fits(keel_admission_t a, keel_task_config_t *c) =
  @     with_other(a, c) == 0 || with_other(a, c) + a.guard_us <= with_gap(a, c);
  @
  @ predicate utilisation_fits(keel_admission_t a, keel_task_config_t *c) =
  @     a.utilisation + utilisation(c) <= a.utilisation_limit;
  @*/

/**
 * Begins with an empty set (requirement ADM-001).
 *
 * @param admission         the totals to initialise
 * @param guard_us          the scheduler's guard W, below 2^31 us
 * @param utilisation_limit the highest utilisation, at most KEEL_UTILISATION_FULL_PPM
 */
/*@ requires \valid(admission);
  @ requires guard_us < KEEL_PERIOD_LIMIT_US;
  @ requires utilisation_limit <= KEEL_UTILISATION_FULL_PPM;
  @ assigns *admission;
  @ ensures ADM_001_valid: admission_valid(*admission);
  @ ensures ADM_001_limits: admission->guard_us == guard_us &&
  @     admission->utilisation_limit == utilisation_limit;
  @ ensures ADM_001_empty: admission->utilisation == 0 && admission->realtime_demand_us == 0 &&
  @     admission->shortest_realtime_us == UINT64_MAX &&
  @     admission->shortest_gap_us == UINT64_MAX && admission->longest_other_us == 0 &&
  @     admission->tasks == 0;
  @*/
void keel_admission_init(keel_admission_t *admission, uint32_t guard_us,
                         uint32_t utilisation_limit);

/**
 * Admits one more task, or refuses it and leaves the totals alone (requirement ADM-002).
 *
 * @param admission totals of the tasks admitted so far
 * @param config    a valid declaration (keel_task_check)
 * @return KEEL_OK, or the first that applies of KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP,
 *         KEEL_ERR_UTILISATION
 */
/*@ requires \valid(admission) && \valid_read(config) && \separated(admission, config);
  @ requires admission_valid(*admission) && admission->tasks < KEEL_QUEUE_CAPACITY;
  @ requires config_valid(config);
  @ assigns *admission;
  @ ensures ADM_002_valid: admission_valid(*admission);
  @ ensures ADM_002_limits: admission->guard_us == \old(admission->guard_us) &&
  @     admission->utilisation_limit == \old(admission->utilisation_limit);
  @ ensures ADM_002_kept: \result != KEEL_OK ==> admission->tasks == \old(admission->tasks);
  @ behavior demand:
  @   assumes !demand_fits(*admission, config);
  @   assigns \nothing;
  @   ensures ADM_003_demand: \result == KEEL_ERR_REALTIME_DEMAND;
  @ behavior gap:
  @   assumes demand_fits(*admission, config) && !gap_fits(*admission, config);
  @   assigns \nothing;
  @   ensures ADM_003_gap: \result == KEEL_ERR_BUDGET_GAP;
  @ behavior utilisation:
  @   assumes demand_fits(*admission, config) && gap_fits(*admission, config);
  @   assumes !utilisation_fits(*admission, config);
  @   assigns \nothing;
  @   ensures ADM_003_utilisation: \result == KEEL_ERR_UTILISATION;
  @ behavior admitted:
  @   assumes demand_fits(*admission, config) && gap_fits(*admission, config);
  @   assumes utilisation_fits(*admission, config);
  @   ensures ok: \result == KEEL_OK;
  @   ensures ADM_002_tasks: admission->tasks == \old(admission->tasks) + 1;
  @   ensures ADM_002_utilisation: admission->utilisation ==
  @       \old(admission->utilisation) + utilisation(config);
  @   ensures ADM_002_demand:
  @       admission->realtime_demand_us == with_demand(\old(*admission), config);
  @   ensures ADM_002_period:
  @       admission->shortest_realtime_us == with_period(\old(*admission), config);
  @   ensures ADM_002_gap: admission->shortest_gap_us == with_gap(\old(*admission), config);
  @   ensures ADM_002_other: admission->longest_other_us == with_other(\old(*admission), config);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_admission_admit(keel_admission_t *admission, const keel_task_config_t *config);

/*@ // Sum of the budgets of the real-time tasks among the first n of the queue.
  @ logic integer realtime_demand(keel_queue_t *q, integer n) =
  @     (n <= 0) ? 0 : realtime_demand(q, n - 1) + realtime_budget(q->task[n - 1]->config);
  @
  @ // Sum of the utilisations of the first n tasks of the queue, in ppm.
  @ logic integer total_utilisation(keel_queue_t *q, integer n) =
  @     (n <= 0) ? 0 : total_utilisation(q, n - 1) + utilisation(q->task[n - 1]->config);
  @
  @ // Every real-time period holds all real-time budgets and the guard twice.
  @ predicate demand_admitted(keel_queue_t *q, integer guard_us) =
  @     \forall integer i; 0 <= i < q->realtime_count ==>
  @         realtime_demand(q, q->count) + 2 * guard_us <= q->task[i]->config->period_us;
  @
  @ // Every other budget fits the gap that each real-time task leaves.
  @ predicate gaps_admitted(keel_queue_t *q, integer guard_us) =
  @     \forall integer i, j; 0 <= i < q->realtime_count <= j < q->count ==>
  @         q->task[j]->config->budget_us + guard_us
  @             <= q->task[i]->config->period_us - q->task[i]->config->budget_us;
  @
  @ // The same of the tasks of the queue and one more: the periods hold the demand of all ...
  @ predicate periods_hold_with(keel_queue_t *q, keel_task_config_t *c, integer guard_us) =
  @     \forall integer i; 0 <= i < q->realtime_count ==>
  @         realtime_demand(q, q->count) + realtime_budget(c) + 2 * guard_us
  @             <= q->task[i]->config->period_us;
  @
  @ predicate period_holds_all(keel_queue_t *q, keel_task_config_t *c, integer guard_us) =
  @     c->priority == KEEL_PRIORITY_REALTIME ==>
  @         realtime_demand(q, q->count) + c->budget_us + 2 * guard_us <= c->period_us;
  @
  @ // ... and the budgets fit the gaps.
  @ predicate fits_gaps(keel_queue_t *q, keel_task_config_t *c, integer guard_us) =
  @     c->priority != KEEL_PRIORITY_REALTIME ==>
  @         \forall integer i; 0 <= i < q->realtime_count ==> c->budget_us + guard_us
  @             <= q->task[i]->config->period_us - q->task[i]->config->budget_us;
  @
  @ predicate leaves_gaps(keel_queue_t *q, keel_task_config_t *c, integer guard_us) =
  @     c->priority == KEEL_PRIORITY_REALTIME ==>
  @         \forall integer j; q->realtime_count <= j < q->count ==>
  @             q->task[j]->config->budget_us + guard_us <= c->period_us - c->budget_us;
  @*/

/**
 * Admits the tasks of a queue in order, up to the first that is refused (requirement ADM-004).
 *
 * @param admission totals of an empty set (keel_admission_init)
 * @param queue     a valid queue of checked tasks
 * @return KEEL_OK when all are admitted; otherwise the reason for which the task with index
 *         admission->tasks is refused
 */
/*@ requires \valid(admission) && \valid_read(queue) && \separated(admission, queue);
  @ requires queue_valid(queue) && queue_checked(queue);
  @ requires \forall integer i; 0 <= i < queue->count ==>
  @     \separated(admission, queue->task[i]);
  @ requires \forall integer i; 0 <= i < queue->count ==>
  @     \separated(admission, queue->task[i]->config);
  @ requires admission_valid(*admission) && admission->tasks == 0;
  @ requires admission->realtime_demand_us == 0 && admission->utilisation == 0;
  @ assigns *admission;
  @ ensures ADM_002_valid: admission_valid(*admission);
  @ ensures ADM_002_limits: admission->guard_us == \old(admission->guard_us) &&
  @     admission->utilisation_limit == \old(admission->utilisation_limit);
  @ ensures ADM_004_offender: \result != KEEL_OK ==> admission->tasks < queue->count;
  @ ensures ADM_004_all: \result == KEEL_OK ==> admission->tasks == queue->count;
  @ ensures ADM_004_demand: \result == KEEL_OK ==>
  @     demand_admitted(queue, admission->guard_us);
  @ ensures ADM_004_gaps: \result == KEEL_OK ==> gaps_admitted(queue, admission->guard_us);
  @ ensures ADM_004_utilisation: \result == KEEL_OK ==>
  @     total_utilisation(queue, queue->count) <= admission->utilisation_limit;
  @ ensures ADM_004_totals: \result == KEEL_OK ==>
  @     admission->realtime_demand_us == realtime_demand(queue, queue->count) &&
  @     admission->utilisation == total_utilisation(queue, queue->count);
  @ ensures ADM_004_some: \result == KEEL_OK ==> 0 < queue->realtime_count ==>
  @     admission->realtime_demand_us > 0;
  @ ensures ADM_004_period: \result == KEEL_OK ==>
  @     \forall integer i; 0 <= i < queue->realtime_count ==>
  @         admission->shortest_realtime_us <= queue->task[i]->config->period_us;
  @ ensures ADM_004_gap: \result == KEEL_OK ==>
  @     \forall integer i; 0 <= i < queue->realtime_count ==> admission->shortest_gap_us <=
  @         \max(0, queue->task[i]->config->period_us - queue->task[i]->config->budget_us);
  @ ensures ADM_004_other: \result == KEEL_OK ==>
  @     \forall integer j; queue->realtime_count <= j < queue->count ==>
  @         admission->longest_other_us >= queue->task[j]->config->budget_us;
  @*/
keel_status_t keel_admission_queue(keel_admission_t *admission, const keel_queue_t *queue);

#endif
