/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/lateness.h
 * @brief The contracts of lateness.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_LATENESS_H
#define KEEL_INTERNAL_RTOS_LATENESS_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/admission.h"
#include "keel/internal/rtos/decision.h"
#include "keel/internal/rtos/scheduler_state.h"
#include "keel/internal/rtos/task.h"
#include "keel/rtos/lateness.h"

KEEL_C_BEGIN

/*@ // The bounds of the isolation theorems. ISO-001: all other real-time budgets and W.
  @ logic integer late_unpromoted(integer all_us, integer own_us, integer guard_us) =
  @     all_us - own_us + guard_us;
  @
  @ // All that can pass between two looks at a real-time task where tasks are promoted.
  @ logic integer late_turn(integer all_us, integer guard_us, integer longest_us) =
  @     all_us + 2 * guard_us + longest_us;
  @
  @ // ISO-002: all of that, less its own budget where its period holds it.
  @ logic integer late_whatever(integer all_us, integer own_us, integer period_us,
  @                             integer guard_us, integer longest_us) =
  @     (late_turn(all_us, guard_us, longest_us) <= period_us)
  @         ? late_turn(all_us, guard_us, longest_us) - own_us
  @         : late_turn(all_us, guard_us, longest_us);
  @
  @ // Nothing is ever promoted: the scheduler is configured so, or there is nothing to promote.
  @ predicate never_promotes(keel_scheduler_t *s) =
  @     s->config.without_promotion != 0 || s->queue.realtime_count == s->queue.count;
  @
  @ // A task's position is that of a real-time one.
  @ predicate is_realtime(keel_scheduler_t *s, keel_task_config_t *task) =
  @     \exists integer i; 0 <= i < s->queue.realtime_count && is_at(s, i, task);
  @
  @ // Both bounds of the task at position i.
  @ logic integer unpromoted_at(keel_scheduler_t *s, integer i) =
  @     late_unpromoted(realtime_demand(&s->queue, s->queue.count),
  @                     s->queue.budget_us[s->queue.order[i]], s->config.guard_us);
  @
  @ logic integer whatever_at(keel_scheduler_t *s, integer i) =
  @     late_whatever(realtime_demand(&s->queue, s->queue.count),
  @                   s->queue.budget_us[s->queue.order[i]],
  @                   s->queue.period_us[s->queue.order[i]], s->config.guard_us,
  @                   longest_other(&s->queue, s->queue.count));
  @
  @ // All that can pass between two looks at it exceeds its period.
  @ predicate too_short_at(keel_scheduler_t *s, integer i) =
  @     s->queue.period_us[s->queue.order[i]] <
  @         late_turn(realtime_demand(&s->queue, s->queue.count), s->config.guard_us,
  @                   longest_other(&s->queue, s->queue.count));
  @*/

/*@ requires scheduler == \null || (\valid_read(scheduler) && scheduler_valid(scheduler));
  @ requires lateness == \null || \valid(lateness);
  @ requires scheduler != \null && lateness != \null ==> \separated(scheduler, lateness);
  @ assigns *lateness;
  @ behavior null:
  @   assumes scheduler == \null || task == \null || lateness == \null;
  @   assigns \nothing;
  @   ensures LAT_003_null: \result == KEEL_ERR_NULL;
  @ behavior unknown:
  @   assumes scheduler != \null && task != \null && lateness != \null;
  @   assumes !queue_holds(&scheduler->queue, task);
  @   assigns \nothing;
  @   ensures LAT_003_unknown: \result == KEEL_ERR_UNKNOWN_TASK;
  @ behavior refused:
  @   assumes scheduler != \null && task != \null && lateness != \null;
  @   assumes queue_holds(&scheduler->queue, task) && !scheduler_holds(scheduler);
  @   assigns \nothing;
  @   ensures LAT_003_offender: \exists integer n; 0 <= n < scheduler->queue.count &&
  @       scheduler_holds_of(scheduler, n) && scheduler_refused(scheduler, n + 1, \result);
  @ behavior realtime:
  @   assumes scheduler != \null && task != \null && lateness != \null;
  @   assumes is_realtime(scheduler, task) && scheduler_holds(scheduler);
  @   ensures ok: \result == KEEL_OK;
  @   ensures LAT_001_admitted:
  @       \old(demand_admitted(&scheduler->queue, scheduler->config.guard_us));
  @   ensures LAT_001_unpromoted: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       lateness->unpromoted_us == \old(unpromoted_at(scheduler, i));
  @   ensures LAT_001_never: \old(never_promotes(scheduler)) ==>
  @       lateness->late_us == lateness->unpromoted_us;
  @   ensures LAT_001_late: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       \old(!never_promotes(scheduler)) ==>
  @       lateness->late_us == \old(whatever_at(scheduler, i));
  @   ensures LAT_001_promotes: lateness->promotes != 0 <==> \old(!never_promotes(scheduler));
  @   ensures LAT_001_skips: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       (lateness->skips != 0 <==>
  @        \old(!never_promotes(scheduler) && too_short_at(scheduler, i)));
  @ behavior other:
  @   assumes scheduler != \null && task != \null && lateness != \null;
  @   assumes queue_holds(&scheduler->queue, task) && !is_realtime(scheduler, task);
  @   assumes scheduler_holds(scheduler);
  @   ensures ok: \result == KEEL_OK;
  @   ensures LAT_002_late: lateness->late_us == KEEL_TIME_NEVER_US;
  @   ensures LAT_002_unpromoted: lateness->unpromoted_us == KEEL_TIME_NEVER_US;
  @   ensures LAT_002_skips: lateness->skips != 0;
  @   ensures LAT_002_promotes: lateness->promotes != 0 <==> \old(!never_promotes(scheduler));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_lateness(const keel_scheduler_t *scheduler,
                                      const keel_task_config_t *task, keel_lateness_t *lateness);

KEEL_C_END

#endif
