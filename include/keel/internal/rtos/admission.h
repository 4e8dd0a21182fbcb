/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/admission.h
 * @brief The functions of admission.h, which the kernel alone calls, and their contracts.
 */
#ifndef KEEL_INTERNAL_RTOS_ADMISSION_H
#define KEEL_INTERNAL_RTOS_ADMISSION_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/priority.h"
#include "keel/internal/rtos/queue.h"
#include "keel/rtos/admission.h"

KEEL_C_BEGIN

/*@ // C / T in parts per million, rounded up.
  @ logic integer utilisation(integer period_us, integer budget_us) =
  @     (budget_us * KEEL_UTILISATION_FULL_PPM + period_us - 1) / period_us;
  @
  @ logic integer realtime_budget(integer priority, integer budget_us) =
  @     (priority == KEEL_PRIORITY_REALTIME) ? budget_us : 0;
  @
  @ // The rules, on the totals of a set.
  @ predicate demand_rule(integer demand_us, integer shortest_us, integer guard_us) =
  @     demand_us == 0 || demand_us + 2 * guard_us <= shortest_us;
  @
  @ predicate gap_rule(integer other_us, integer gap_us, integer guard_us) =
  @     other_us == 0 || other_us + guard_us <= gap_us;
  @
  @ predicate admissible(keel_admission_t a) =
  @     demand_rule(a.realtime_demand_us, a.shortest_realtime_us, a.guard_us) &&
  @     gap_rule(a.longest_other_us, a.shortest_gap_us, a.guard_us) &&
  @     a.utilisation_ppm <= a.utilisation_limit_ppm;
  @
  @ // Totals that cannot overflow: the limits are in range and the demand is below a period.
  @ predicate admission_valid(keel_admission_t a) =
  @     a.guard_us < KEEL_PERIOD_LIMIT_US && a.utilisation_limit_ppm <= KEEL_UTILISATION_FULL_PPM &&
  @     a.realtime_demand_us < KEEL_PERIOD_LIMIT_US &&
  @     a.longest_other_us <= UINT32_MAX && a.tasks <= KEEL_QUEUE_CAPACITY && admissible(a);
  @
  @ // The totals with one more task.
  @ logic integer with_period(integer shortest_us, integer priority, integer period_us) =
  @     (priority == KEEL_PRIORITY_REALTIME) ? \min(shortest_us, period_us) : shortest_us;
  @
  @ logic integer with_gap(integer gap_us, integer priority, integer period_us,
  @                        integer budget_us) =
  @     (priority == KEEL_PRIORITY_REALTIME)
  @         ? \min(gap_us, \max(0, period_us - budget_us)) : gap_us;
  @
  @ logic integer with_other(integer other_us, integer priority, integer budget_us) =
  @     (priority == KEEL_PRIORITY_REALTIME) ? other_us : \max(other_us, budget_us);
  @
  @ predicate demand_fits(keel_admission_t a, integer priority, integer period_us,
  @                       integer budget_us) =
  @     demand_rule(a.realtime_demand_us + realtime_budget(priority, budget_us),
  @                 with_period(a.shortest_realtime_us, priority, period_us), a.guard_us);
  @
  @ predicate gap_fits(keel_admission_t a, integer priority, integer period_us,
  @                    integer budget_us) =
  @     gap_rule(with_other(a.longest_other_us, priority, budget_us),
  @              with_gap(a.shortest_gap_us, priority, period_us, budget_us), a.guard_us);
  @
  @ predicate utilisation_fits(keel_admission_t a, integer period_us, integer budget_us) =
  @     a.utilisation_ppm + utilisation(period_us, budget_us) <= a.utilisation_limit_ppm;
  @*/

/**
 * Begins with an empty set (requirement ADM-001).
 *
 * @param admission             the totals to initialise
 * @param guard_us              the scheduler's guard W, below 2^31 us
 * @param utilisation_limit_ppm the highest utilisation, at most KEEL_UTILISATION_FULL_PPM
 */
/*@ requires \valid(admission);
  @ requires guard_us < KEEL_PERIOD_LIMIT_US;
  @ requires utilisation_limit_ppm <= KEEL_UTILISATION_FULL_PPM;
  @ assigns *admission;
  @ ensures ADM_001_valid: admission_valid(*admission);
  @ ensures ADM_001_limits: admission->guard_us == guard_us &&
  @     admission->utilisation_limit_ppm == utilisation_limit_ppm;
  @ ensures ADM_001_empty: admission->utilisation_ppm == 0 && admission->realtime_demand_us == 0 &&
  @     admission->shortest_realtime_us == UINT64_MAX &&
  @     admission->shortest_gap_us == UINT64_MAX && admission->longest_other_us == 0 &&
  @     admission->tasks == 0;
  @*/
void keel_admission_init(keel_admission_t *admission, uint32_t guard_us,
                         uint32_t utilisation_limit_ppm);

/**
 * Admits one more task, or refuses it and keeps the totals (requirement ADM-002).
 *
 * @param admission totals of the tasks admitted so far
 * @param priority  the task's static priority
 * @param period_us its period, 1 to 2^31 - 1 us
 * @param budget_us its budget, at least 1 us
 * @return KEEL_OK, or the first that applies of KEEL_ERR_REALTIME_DEMAND, KEEL_ERR_BUDGET_GAP,
 *         KEEL_ERR_UTILISATION
 */
/*@ requires \valid(admission);
  @ requires admission_valid(*admission) && admission->tasks < KEEL_QUEUE_CAPACITY;
  @ requires period_valid(period_us) && 0 < budget_us;
  @ assigns *admission;
  @ ensures ADM_002_valid: admission_valid(*admission);
  @ ensures ADM_002_limits: admission->guard_us == \old(admission->guard_us) &&
  @     admission->utilisation_limit_ppm == \old(admission->utilisation_limit_ppm);
  @ ensures ADM_002_kept: \result != KEEL_OK ==> admission->tasks == \old(admission->tasks) &&
  @     admission->utilisation_ppm == \old(admission->utilisation_ppm) &&
  @     admission->realtime_demand_us == \old(admission->realtime_demand_us) &&
  @     admission->shortest_realtime_us == \old(admission->shortest_realtime_us) &&
  @     admission->shortest_gap_us == \old(admission->shortest_gap_us) &&
  @     admission->longest_other_us == \old(admission->longest_other_us);
  @ behavior demand:
  @   assumes !demand_fits(*admission, priority, period_us, budget_us);
  @   assigns \nothing;
  @   ensures ADM_003_demand: \result == KEEL_ERR_REALTIME_DEMAND;
  @ behavior gap:
  @   assumes demand_fits(*admission, priority, period_us, budget_us);
  @   assumes !gap_fits(*admission, priority, period_us, budget_us);
  @   assigns \nothing;
  @   ensures ADM_003_gap: \result == KEEL_ERR_BUDGET_GAP;
  @ behavior utilisation:
  @   assumes demand_fits(*admission, priority, period_us, budget_us);
  @   assumes gap_fits(*admission, priority, period_us, budget_us);
  @   assumes !utilisation_fits(*admission, period_us, budget_us);
  @   assigns \nothing;
  @   ensures ADM_003_utilisation: \result == KEEL_ERR_UTILISATION;
  @ behavior admitted:
  @   assumes demand_fits(*admission, priority, period_us, budget_us);
  @   assumes gap_fits(*admission, priority, period_us, budget_us);
  @   assumes utilisation_fits(*admission, period_us, budget_us);
  @   ensures ok: \result == KEEL_OK;
  @   ensures ADM_002_tasks: admission->tasks == \old(admission->tasks) + 1;
  @   ensures ADM_002_utilisation: admission->utilisation_ppm ==
  @       \old(admission->utilisation_ppm) + utilisation(period_us, budget_us);
  @   ensures ADM_002_demand: admission->realtime_demand_us ==
  @       \old(admission->realtime_demand_us) + realtime_budget(priority, budget_us);
  @   ensures ADM_002_period: admission->shortest_realtime_us ==
  @       with_period(\old(admission->shortest_realtime_us), priority, period_us);
  @   ensures ADM_002_gap: admission->shortest_gap_us ==
  @       with_gap(\old(admission->shortest_gap_us), priority, period_us, budget_us);
  @   ensures ADM_002_other: admission->longest_other_us ==
  @       with_other(\old(admission->longest_other_us), priority, budget_us);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_admission_admit(keel_admission_t *admission, uint32_t priority,
                                   uint32_t period_us, uint32_t budget_us);

/*@ // Admission asks of the order that each of its tasks has a slot.
  @ predicate queue_slots(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> q->order[i] < KEEL_QUEUE_CAPACITY;
  @
  @ // The totals of the first n tasks of a queue: the sum of the real-time budgets, ...
  @ logic integer realtime_demand(keel_queue_t *q, integer n) =
  @     (n <= 0) ? 0 : realtime_demand(q, n - 1) +
  @         realtime_budget(q->priority[q->order[n - 1]], q->budget_us[q->order[n - 1]]);
  @
  @ // ... of the utilisations, in ppm, ...
  @ logic integer total_utilisation(keel_queue_t *q, integer n) =
  @     (n <= 0) ? 0 : total_utilisation(q, n - 1) +
  @         utilisation(q->period_us[q->order[n - 1]], q->budget_us[q->order[n - 1]]);
  @
  @ // ... the shortest real-time period, ...
  @ logic integer shortest_realtime(keel_queue_t *q, integer n) =
  @     (n <= 0) ? UINT64_MAX : with_period(shortest_realtime(q, n - 1),
  @         q->priority[q->order[n - 1]], q->period_us[q->order[n - 1]]);
  @
  @ // ... the shortest gap that a real-time task leaves ...
  @ logic integer shortest_gap(keel_queue_t *q, integer n) =
  @     (n <= 0) ? UINT64_MAX : with_gap(shortest_gap(q, n - 1),
  @         q->priority[q->order[n - 1]], q->period_us[q->order[n - 1]],
  @         q->budget_us[q->order[n - 1]]);
  @
  @ // ... and the longest budget of another task.
  @ logic integer longest_other(keel_queue_t *q, integer n) =
  @     (n <= 0) ? 0 : with_other(longest_other(q, n - 1), q->priority[q->order[n - 1]],
  @         q->budget_us[q->order[n - 1]]);
  @
  @ // The totals hold what they say of the first n tasks.
  @ predicate totals_of(keel_admission_t a, keel_queue_t *q, integer n) =
  @     a.tasks == n && a.realtime_demand_us == realtime_demand(q, n) &&
  @     a.utilisation_ppm == total_utilisation(q, n) &&
  @     a.shortest_realtime_us == shortest_realtime(q, n) &&
  @     a.shortest_gap_us == shortest_gap(q, n) && a.longest_other_us == longest_other(q, n);
  @
  @ // The rules for the first n tasks of a queue.
  @ predicate demand_holds(keel_queue_t *q, integer n, integer guard_us) =
  @     demand_rule(realtime_demand(q, n), shortest_realtime(q, n), guard_us);
  @
  @ predicate gap_holds(keel_queue_t *q, integer n, integer guard_us) =
  @     gap_rule(longest_other(q, n), shortest_gap(q, n), guard_us);
  @
  @ predicate utilisation_holds(keel_queue_t *q, integer n, integer limit) =
  @     total_utilisation(q, n) <= limit;
  @
  @ predicate set_holds(keel_queue_t *q, integer n, integer guard_us, integer limit) =
  @     demand_holds(q, n, guard_us) && gap_holds(q, n, guard_us) &&
  @     utilisation_holds(q, n, limit);
  @
  @ // Why the first n tasks are refused: the first rule that they break.
  @ predicate set_refused(keel_queue_t *q, integer n, integer guard_us, integer limit,
  @                       integer status) =
  @     (status == KEEL_ERR_REALTIME_DEMAND && !demand_holds(q, n, guard_us)) ||
  @     (status == KEEL_ERR_BUDGET_GAP && demand_holds(q, n, guard_us) &&
  @      !gap_holds(q, n, guard_us)) ||
  @     (status == KEEL_ERR_UTILISATION && demand_holds(q, n, guard_us) &&
  @      gap_holds(q, n, guard_us) && !utilisation_holds(q, n, limit));
  @
  @ // The rules for all tasks of a queue and one more.
  @ predicate demand_holds_with(keel_queue_t *q, integer priority, integer period_us,
  @                             integer budget_us, integer guard_us) =
  @     demand_rule(realtime_demand(q, q->count) + realtime_budget(priority, budget_us),
  @                 with_period(shortest_realtime(q, q->count), priority, period_us), guard_us);
  @
  @ predicate gap_holds_with(keel_queue_t *q, integer priority, integer period_us,
  @                          integer budget_us, integer guard_us) =
  @     gap_rule(with_other(longest_other(q, q->count), priority, budget_us),
  @              with_gap(shortest_gap(q, q->count), priority, period_us, budget_us), guard_us);
  @
  @ predicate utilisation_holds_with(keel_queue_t *q, integer period_us, integer budget_us,
  @                                  integer limit) =
  @     total_utilisation(q, q->count) + utilisation(period_us, budget_us) <= limit;
  @
  @ // The rules as they are told: every real-time period holds all real-time budgets and the guard
  @ // twice ...
  @ predicate demand_admitted(keel_queue_t *q, integer guard_us) =
  @     \forall integer i; 0 <= i < q->realtime_count ==>
  @         realtime_demand(q, q->count) + 2 * guard_us <= q->period_us[q->order[i]];
  @
  @ // ... and every other budget fits the gap that each real-time task leaves.
  @ predicate gaps_admitted(keel_queue_t *q, integer guard_us) =
  @     \forall integer i, j; 0 <= i < q->realtime_count <= j < q->count ==>
  @         q->budget_us[q->order[j]] + guard_us
  @             <= q->period_us[q->order[i]] - q->budget_us[q->order[i]];
  @*/

/**
 * Admits the tasks of a queue in order, up to the first that is refused (requirement ADM-004).
 *
 * @param admission totals of an empty set (keel_admission_init)
 * @param queue     a valid queue
 * @return KEEL_OK when all are admitted; otherwise the reason for which the task at position
 *         admission->tasks is refused
 */
/*@ requires \valid(admission) && \valid_read(queue) && \separated(admission, queue);
  @ requires queue_counts(queue) && queue_slots(queue);
  @ requires queue_realtime_first(queue) && queue_others_last(queue);
  @ requires queue_periods(queue) && queue_budgets(queue);
  @ requires admission_valid(*admission) && totals_of(*admission, queue, 0);
  @ assigns *admission;
  @ ensures ADM_004_valid: admission_valid(*admission);
  @ ensures ADM_004_limits: admission->guard_us == \old(admission->guard_us) &&
  @     admission->utilisation_limit_ppm == \old(admission->utilisation_limit_ppm);
  @ ensures ADM_004_range: admission->tasks <= queue->count;
  @ ensures ADM_004_totals: totals_of(*admission, queue, admission->tasks);
  @ ensures ADM_004_all: \result == KEEL_OK <==> admission->tasks == queue->count;
  @ ensures ADM_004_offender: \result != KEEL_OK ==> set_refused(queue, admission->tasks + 1,
  @     admission->guard_us, admission->utilisation_limit_ppm, \result);
  @ ensures ADM_004_complete: \result == KEEL_OK <==> set_holds(queue, queue->count,
  @     admission->guard_us, admission->utilisation_limit_ppm);
  @ ensures ADM_004_told: \result == KEEL_OK <==>
  @     demand_admitted(queue, admission->guard_us) &&
  @     gaps_admitted(queue, admission->guard_us) &&
  @     utilisation_holds(queue, queue->count, admission->utilisation_limit_ppm);
  @*/
keel_status_t keel_admission_queue(keel_admission_t *admission, const keel_queue_t *queue);

KEEL_C_END

#endif
