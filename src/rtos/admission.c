/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/admission.h"

void keel_admission_init(keel_admission_t *admission, uint32_t guard_us,
                         uint32_t utilisation_limit_ppm)
{
    admission->guard_us = guard_us;
    admission->utilisation_limit_ppm = utilisation_limit_ppm;
    admission->utilisation_ppm = 0u;
    admission->realtime_demand_us = 0u;
    admission->shortest_realtime_us = UINT64_MAX;
    admission->shortest_gap_us = UINT64_MAX;
    admission->longest_other_us = 0u;
    admission->tasks = 0u;
}

/*@ assigns \nothing;
  @ ensures \result == \min(a, b);
  @*/
static uint64_t lesser_of(uint64_t a, uint64_t b)
{
    return (a < b) ? a : b;
}

/*@ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures \result == utilisation(period_us, budget_us);
  @*/
static uint64_t utilisation_of(uint32_t period_us, uint32_t budget_us)
{
    const uint64_t scaled = (uint64_t)budget_us * KEEL_UTILISATION_FULL_PPM;

    return (scaled + ((uint64_t)period_us - 1u)) / period_us;
}

/*@ assigns \nothing;
  @ ensures \result == \max(0, period_us - budget_us);
  @*/
static uint64_t gap_of(uint32_t period_us, uint32_t budget_us)
{
    return (budget_us < period_us) ? (period_us - budget_us) : 0u;
}

keel_status_t keel_admission_admit(keel_admission_t *admission, uint32_t priority,
                                   uint32_t period_us, uint32_t budget_us)
{
    const uint64_t utilisation_ppm = admission->utilisation_ppm +
                                     utilisation_of(period_us, budget_us);
    uint64_t demand_us = admission->realtime_demand_us;
    uint64_t shortest_us = admission->shortest_realtime_us;
    uint64_t gap_us = admission->shortest_gap_us;
    uint64_t other_us = admission->longest_other_us;

    if (priority == KEEL_PRIORITY_REALTIME) {
        demand_us += budget_us;
        shortest_us = lesser_of(shortest_us, period_us);
        gap_us = lesser_of(gap_us, gap_of(period_us, budget_us));
    } else if (budget_us > other_us) {
        other_us = budget_us;
    } else {
        /* A longer budget was admitted before: no limit changes. */
    }
    if ((demand_us > 0u) && ((demand_us + (2u * admission->guard_us)) > shortest_us)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if ((other_us > 0u) && ((other_us + admission->guard_us) > gap_us)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    if (utilisation_ppm > admission->utilisation_limit_ppm) {
        return KEEL_ERR_UTILISATION;
    }
    admission->utilisation_ppm = utilisation_ppm;
    admission->realtime_demand_us = demand_us;
    admission->shortest_realtime_us = shortest_us;
    admission->shortest_gap_us = gap_us;
    admission->longest_other_us = other_us;
    admission->tasks++;
    return KEEL_OK;
}

/* Provers do no induction: that totals only get worse from task to task, and that the rules on the
 * totals are those on the tasks, is carried by ghost loops. */

/*@ ghost
/@ requires \valid_read(queue) && 0 < n <= KEEL_QUEUE_CAPACITY;
 @ assigns \nothing;
 @ ensures demand: realtime_demand(queue, n) == realtime_demand(queue, n - 1) +
 @     realtime_budget(queue->priority[queue->order[n - 1]], queue->budget_us[queue->order[n - 1]]);
 @ ensures period: shortest_realtime(queue, n) == with_period(shortest_realtime(queue, n - 1),
 @     queue->priority[queue->order[n - 1]], queue->period_us[queue->order[n - 1]]);
 @ ensures gap: shortest_gap(queue, n) == with_gap(shortest_gap(queue, n - 1),
 @     queue->priority[queue->order[n - 1]], queue->period_us[queue->order[n - 1]],
 @     queue->budget_us[queue->order[n - 1]]);
 @ ensures other: longest_other(queue, n) == with_other(longest_other(queue, n - 1),
 @     queue->priority[queue->order[n - 1]], queue->budget_us[queue->order[n - 1]]);
 @ ensures utilisation: total_utilisation(queue, n) == total_utilisation(queue, n - 1) +
 @     utilisation(queue->period_us[queue->order[n - 1]], queue->budget_us[queue->order[n - 1]]);
 @/
static void totals_step(const keel_queue_t *queue, uint32_t n)
{
}
*/

/*@ ghost
/@ requires \valid_read(queue) && queue_counts(queue) && queue_slots(queue);
 @ requires queue_periods(queue) && tasks <= queue->count;
 @ assigns \nothing;
 @ ensures demand: realtime_demand(queue, tasks) <= realtime_demand(queue, queue->count);
 @ ensures period: shortest_realtime(queue, queue->count) <= shortest_realtime(queue, tasks);
 @ ensures gap: shortest_gap(queue, queue->count) <= shortest_gap(queue, tasks);
 @ ensures other: longest_other(queue, tasks) <= longest_other(queue, queue->count);
 @ ensures utilisation:
 @     total_utilisation(queue, tasks) <= total_utilisation(queue, queue->count);
 @/
static void totals_worsen(const keel_queue_t *queue, uint32_t tasks)
{
    /@ loop invariant range: tasks <= n <= queue->count;
     @ loop invariant demand: realtime_demand(queue, tasks) <= realtime_demand(queue, n);
     @ loop invariant period: shortest_realtime(queue, n) <= shortest_realtime(queue, tasks);
     @ loop invariant gap: shortest_gap(queue, n) <= shortest_gap(queue, tasks);
     @ loop invariant other: longest_other(queue, tasks) <= longest_other(queue, n);
     @ loop invariant utilisation:
     @     total_utilisation(queue, tasks) <= total_utilisation(queue, n);
     @ loop assigns n;
     @ loop variant queue->count - n;
     @/
    for (uint32_t n = tasks; n < queue->count; n++) {
        totals_step(queue, n + 1u);
    }
}
*/

/*@ ghost
/@ requires \valid_read(queue) && queue_counts(queue) && queue_slots(queue);
 @ requires queue_periods(queue) && tasks <= queue->count;
 @ requires 0 <= realtime_demand(queue, tasks) && 0 <= longest_other(queue, tasks);
 @ assigns \nothing;
 @ ensures demand: demand_holds(queue, queue->count, guard_us) ==>
 @     demand_holds(queue, tasks, guard_us);
 @ ensures gap: gap_holds(queue, queue->count, guard_us) ==> gap_holds(queue, tasks, guard_us);
 @ ensures utilisation: utilisation_holds(queue, queue->count, limit) ==>
 @     utilisation_holds(queue, tasks, limit);
 @/
static void rules_stay_broken(const keel_queue_t *queue, uint32_t tasks, uint64_t guard_us,
                              uint64_t limit)
{
    totals_worsen(queue, tasks);
}
*/

/*@ ghost
/@ requires \valid_read(queue) && queue_counts(queue) && queue_slots(queue);
 @ requires queue_realtime_first(queue) && queue_others_last(queue);
 @ requires queue_periods(queue) && queue_budgets(queue);
 @ assigns \nothing;
 @ ensures told: demand_holds(queue, queue->count, guard_us) <==>
 @     demand_admitted(queue, guard_us);
 @/
static void demand_is_told(const keel_queue_t *queue, uint64_t guard_us)
{
    /@ loop invariant range: 0 <= n <= queue->count;
     @ loop invariant some: 0 < n && 0 < queue->realtime_count ==> 0 < realtime_demand(queue, n);
     @ loop invariant none: shortest_realtime(queue, n) == UINT64_MAX ==>
     @     realtime_demand(queue, n) == 0;
     @ loop invariant positive: 0 <= realtime_demand(queue, n);
     @ loop invariant periods: \forall integer i; 0 <= i < n && i < queue->realtime_count ==>
     @     shortest_realtime(queue, n) <= queue->period_us[queue->order[i]];
     @ loop invariant shortest: demand_admitted(queue, guard_us) ==>
     @     shortest_realtime(queue, n) == UINT64_MAX ||
     @     realtime_demand(queue, queue->count) + 2 * guard_us <= shortest_realtime(queue, n);
     @ loop assigns n;
     @ loop variant queue->count - n;
     @/
    for (uint32_t n = 0u; n < queue->count; n++) {
        totals_step(queue, n + 1u);
    }
}
*/

/*@ ghost
/@ requires \valid_read(queue) && queue_counts(queue) && queue_slots(queue);
 @ requires queue_realtime_first(queue) && queue_others_last(queue);
 @ requires queue_periods(queue) && queue_budgets(queue);
 @ requires guard_us < KEEL_PERIOD_LIMIT_US;
 @ assigns \nothing;
 @ ensures told: gap_holds(queue, queue->count, guard_us) <==> gaps_admitted(queue, guard_us);
 @/
static void gaps_are_told(const keel_queue_t *queue, uint64_t guard_us)
{
    /@ loop invariant range: 0 <= n <= queue->count;
     @ loop invariant none: n <= queue->realtime_count ==> longest_other(queue, n) == 0;
     @ loop invariant bound: 0 <= longest_other(queue, n) <= UINT32_MAX;
     @ loop invariant gaps: \forall integer i; 0 <= i < n && i < queue->realtime_count ==>
     @     shortest_gap(queue, n) <=
     @         \max(0, queue->period_us[queue->order[i]] - queue->budget_us[queue->order[i]]);
     @ loop invariant others: \forall integer i; queue->realtime_count <= i < n ==>
     @     queue->budget_us[queue->order[i]] <= longest_other(queue, n);
     @ loop invariant shortest: gaps_admitted(queue, guard_us) ==>
     @     shortest_gap(queue, n) == UINT64_MAX ||
     @     \forall integer i; queue->realtime_count <= i < queue->count ==>
     @         queue->budget_us[queue->order[i]] + guard_us <= shortest_gap(queue, n);
     @ loop invariant rule: gaps_admitted(queue, guard_us) ==> gap_holds(queue, n, guard_us);
     @ loop assigns n;
     @ loop variant queue->count - n;
     @/
    for (uint32_t n = 0u; n < queue->count; n++) {
        totals_step(queue, n + 1u);
    }
}
*/

/* Admits the task at a position, to the totals of those before it. */
/*@ requires \valid(admission) && \valid_read(queue) && \separated(admission, queue);
  @ requires position < KEEL_QUEUE_CAPACITY && queue->order[position] < KEEL_QUEUE_CAPACITY;
  @ requires period_valid(queue->period_us[queue->order[position]]);
  @ requires 0 < queue->budget_us[queue->order[position]];
  @ requires admission_valid(*admission) && totals_of(*admission, queue, position);
  @ assigns *admission;
  @ ensures valid: admission_valid(*admission);
  @ ensures limits: admission->guard_us == \old(admission->guard_us) &&
  @     admission->utilisation_limit_ppm == \old(admission->utilisation_limit_ppm);
  @ ensures admitted: \result == KEEL_OK ==> totals_of(*admission, queue, position + 1);
  @ ensures refused: \result != KEEL_OK ==> totals_of(*admission, queue, position);
  @ ensures tasks: \result != KEEL_OK ==> admission->tasks == position;
  @ ensures rule: \result != KEEL_OK ==> set_refused(queue, position + 1,
  @     admission->guard_us, admission->utilisation_limit_ppm, \result);
  @ ensures positive: 0 <= realtime_demand(queue, position + 1) &&
  @     0 <= longest_other(queue, position + 1);
  @ ensures ok: \result == KEEL_OK <==> set_holds(queue, position + 1, admission->guard_us,
  @     admission->utilisation_limit_ppm);
  @*/
static keel_status_t admit_at(keel_admission_t *admission, const keel_queue_t *queue,
                              uint32_t position)
{
    const uint32_t slot = queue->order[position];

    //@ ghost totals_step(queue, position + 1u);
    return keel_admission_admit(admission, queue->priority[slot], queue->period_us[slot],
                                queue->budget_us[slot]);
}

keel_status_t keel_admission_queue(keel_admission_t *admission, const keel_queue_t *queue)
{
    //@ ghost demand_is_told(queue, admission->guard_us);
    //@ ghost gaps_are_told(queue, admission->guard_us);
    /*@ loop invariant range: 0 <= i <= queue->count;
      @ loop invariant totals: totals_of(*admission, queue, i);
      @ loop invariant valid: admission_valid(*admission);
      @ loop invariant limits: admission->guard_us == \at(admission->guard_us, Pre) &&
      @     admission->utilisation_limit_ppm == \at(admission->utilisation_limit_ppm, Pre);
      @ loop assigns i, *admission;
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = 0u; i < queue->count; i++) {
        const keel_status_t status = admit_at(admission, queue, i);

        if (status != KEEL_OK) {
            //@ assert tasks: admission->tasks == i;
            //@ ghost uint64_t guard_us = admission->guard_us;
            //@ ghost uint64_t limit = admission->utilisation_limit_ppm;
            //@ ghost rules_stay_broken(queue, i + 1u, guard_us, limit);
            /*@ assert broken: !set_holds(queue, queue->count, admission->guard_us,
              @     admission->utilisation_limit_ppm);
              @*/
            return status;
        }
    }
    /*@ assert kept: set_holds(queue, queue->count, admission->guard_us,
      @     admission->utilisation_limit_ppm);
      @*/
    return KEEL_OK;
}
