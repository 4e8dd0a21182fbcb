/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/lateness.h"

#include <stddef.h>

/* Whether a task that is not real-time may ever be promoted. */
/*@ requires \valid_read(scheduler) && queue_counts(&scheduler->queue);
  @ assigns \nothing;
  @ ensures \result <==> !never_promotes(scheduler);
  @*/
static bool may_promote(const keel_scheduler_t *scheduler)
{
    return (!scheduler->config.without_promotion) &&
           (scheduler->queue.realtime_count < scheduler->queue.count);
}

/* The totals of all tasks, if they are admitted. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(totals) && \separated(totals, scheduler);
  @ assigns *totals;
  @ ensures valid: admission_valid(*totals) && totals->guard_us == scheduler->config.guard_us;
  @ ensures all: \result == KEEL_OK <==> scheduler_holds(scheduler);
  @ ensures totals: \result == KEEL_OK ==>
  @     totals->realtime_demand_us == realtime_demand(&scheduler->queue, scheduler->queue.count) &&
  @     totals->longest_other_us == longest_other(&scheduler->queue, scheduler->queue.count);
  @ ensures admitted: \result == KEEL_OK ==>
  @     demand_admitted(&scheduler->queue, scheduler->config.guard_us);
  @ ensures offender: \result != KEEL_OK ==> totals->tasks < scheduler->queue.count &&
  @     scheduler_holds_of(scheduler, totals->tasks) &&
  @     scheduler_refused(scheduler, totals->tasks + 1, \result);
  @*/
static keel_status_t admitted_totals(const keel_scheduler_t *scheduler, keel_admission_t *totals)
{
    keel_status_t status;

    keel_admission_init(totals, scheduler->config.guard_us,
                        scheduler->config.utilisation_limit_ppm);
    status = keel_admission_queue(totals, &scheduler->queue);
    //@ assert demand: demand_holds(&scheduler->queue, totals->tasks, scheduler->config.guard_us);
    //@ assert gap: gap_holds(&scheduler->queue, totals->tasks, scheduler->config.guard_us);
    /*@ assert utilisation: utilisation_holds(&scheduler->queue, totals->tasks,
      @     scheduler->config.utilisation_limit_ppm);
      @*/
    return status;
}

/*@ ghost
/@ requires \valid_read(queue) && queue_counts(queue) && queue_slots(queue);
 @ requires queue_realtime_first(queue) && position < queue->realtime_count;
 @ assigns \nothing;
 @ ensures counted: queue->budget_us[queue->order[position]] <=
 @     realtime_demand(queue, queue->count);
 @/
static void own_is_counted(const keel_queue_t *queue, uint32_t position)
{
    /@ loop invariant range: 0 <= n <= queue->count;
     @ loop invariant least: 0 <= realtime_demand(queue, n);
     @ loop invariant counted: position < n ==>
     @     queue->budget_us[queue->order[position]] <= realtime_demand(queue, n);
     @ loop assigns n;
     @ loop variant queue->count - n;
     @/
    for (uint32_t n = 0u; n < queue->count; n++) {
        /@ assert next: realtime_demand(queue, n + 1) == realtime_demand(queue, n) +
         @     realtime_budget(queue->priority[queue->order[n]],
         @                     queue->budget_us[queue->order[n]]);
         @/
    }
}
*/

/* Of a real-time task, by the theorems' terms. */
/*@ requires \valid(lateness) && admission_valid(*totals) && \valid_read(totals);
  @ requires \separated(lateness, totals) && own_us <= totals->realtime_demand_us;
  @ assigns *lateness;
  @ ensures unpromoted: lateness->unpromoted_us ==
  @     late_unpromoted(\old(totals->realtime_demand_us), own_us, \old(totals->guard_us));
  @ ensures late: lateness->late_us == ((promotes == 0)
  @     ? late_unpromoted(\old(totals->realtime_demand_us), own_us, \old(totals->guard_us))
  @     : late_whatever(\old(totals->realtime_demand_us), own_us, period_us,
  @                     \old(totals->guard_us), \old(totals->longest_other_us)));
  @ ensures promotes: lateness->promotes == promotes;
  @ ensures skips: lateness->skips != 0 <==> promotes != 0 && period_us <
  @     late_turn(\old(totals->realtime_demand_us), \old(totals->guard_us),
  @               \old(totals->longest_other_us));
  @*/
static void bound_realtime(const keel_admission_t *totals, uint32_t own_us, uint32_t period_us,
                           bool promotes, keel_lateness_t *lateness)
{
    const uint64_t unpromoted_us = (totals->realtime_demand_us - own_us) + totals->guard_us;
    const uint64_t turn_us = totals->realtime_demand_us + (2u * totals->guard_us) +
                             totals->longest_other_us;
    const bool skips = promotes && (turn_us > period_us);
    uint64_t late_us = unpromoted_us;

    if (skips) {
        late_us = turn_us;
    } else if (promotes) {
        late_us = turn_us - own_us;
    } else {
        /* As long as nothing is promoted, which is for ever. */
    }
    lateness->late_us = late_us;
    lateness->unpromoted_us = unpromoted_us;
    lateness->promotes = promotes;
    lateness->skips = skips;
}

/* Of another task: none. */
/*@ requires \valid(lateness);
  @ assigns *lateness;
  @ ensures late: lateness->late_us == KEEL_TIME_NEVER_US;
  @ ensures unpromoted: lateness->unpromoted_us == KEEL_TIME_NEVER_US;
  @ ensures promotes: lateness->promotes == promotes;
  @ ensures skips: lateness->skips != 0;
  @*/
static void bound_other(bool promotes, keel_lateness_t *lateness)
{
    lateness->late_us = KEEL_TIME_NEVER_US;
    lateness->unpromoted_us = KEEL_TIME_NEVER_US;
    lateness->promotes = promotes;
    lateness->skips = true;
}

keel_status_t keel_scheduler_lateness(const keel_scheduler_t *scheduler,
                                      const keel_task_config_t *task, keel_lateness_t *lateness)
{
    keel_admission_t totals;
    keel_status_t status;
    uint32_t position;
    uint32_t slot;
    bool promotes;

    if ((scheduler == NULL) || (task == NULL) || (lateness == NULL)) {
        return KEEL_ERR_NULL;
    }
    position = keel_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    //@ assert found: is_at(scheduler, position, task);
    /*@ assert realtime: position < scheduler->queue.realtime_count ==>
      @     is_realtime(scheduler, task);
      @*/
    status = admitted_totals(scheduler, &totals);
    if (status != KEEL_OK) {
        return status;
    }
    slot = scheduler->queue.order[position];
    promotes = may_promote(scheduler);
    if (position < scheduler->queue.realtime_count) {
        //@ ghost own_is_counted(&scheduler->queue, position);
        bound_realtime(&totals, scheduler->queue.budget_us[slot], scheduler->queue.period_us[slot],
                       promotes, lateness);
        return KEEL_OK;
    }
    bound_other(promotes, lateness);
    return KEEL_OK;
}
