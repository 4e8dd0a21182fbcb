/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/spread.h
 * @brief The contracts of spread.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_SPREAD_H
#define KEEL_INTERNAL_RTOS_SPREAD_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/queue.h"
#include "keel/internal/rtos/scheduler_state.h"
#include "keel/rtos/spread.h"

KEEL_C_BEGIN

/*@ // The greatest common divisor, as Euclid has it, in n steps. As many as b is are enough, as
  @ // each makes it less.
  @ logic integer divisor_within(integer a, integer b, integer n) =
  @     (n <= 0) ? a : ((b <= 0) ? a : divisor_within(b, a % b, n - 1));
  @
  @ logic integer common_divisor(integer a, integer b) = divisor_within(a, b, b);
  @
  @ // How long a release of the task in slot x keeps others away.
  @ logic integer spread_need(keel_queue_t *q, integer x, integer guard_us) =
  @     q->budget_us[x] + guard_us + 1;
  @
  @ // How far behind the other one a release lies, in a cycle after which both repeat.
  @ logic integer cycle_distance(integer release_us, integer other_us, integer cycle_us) =
  @     (release_us + cycle_us - other_us % cycle_us) % cycle_us;
  @
  @ // The task in slot x, released at that time, keeps apart from the one in slot y.
  @ predicate apart_at(keel_queue_t *q, integer x, integer release_us, integer y,
  @                    integer guard_us) =
  @     spread_need(q, y, guard_us) <=
  @         cycle_distance(release_us, q->release_us[y],
  @                        common_divisor(q->period_us[x], q->period_us[y])) <=
  @         common_divisor(q->period_us[x], q->period_us[y]) - spread_need(q, x, guard_us);
  @
  @ // Two tasks keep apart, as counted from the one or from the other.
  @ predicate keep_apart(keel_queue_t *q, integer x, integer y, integer guard_us) =
  @     apart_at(q, x, q->release_us[x], y, guard_us) ||
  @     apart_at(q, y, q->release_us[y], x, guard_us);
  @
  @ // From state L to M a first release stays, or lies within the task's first period ...
  @ predicate phases_only{L, M}(keel_queue_t *q) =
  @     \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @         \at(q->release_us[x], M) == \at(q->release_us[x], L) ||
  @         \at(q->release_us[x], M) < \at(q->period_us[x], M);
  @
  @ // ... and a free slot stays as it is.
  @ predicate free_untouched{L, M}(keel_queue_t *q) =
  @     \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @         \at(q->task[x], M) == \null ==>
  @         \at(q->release_us[x], M) == \at(q->release_us[x], L);
  @*/

/*@ requires 0 < a < KEEL_PERIOD_LIMIT_US && b < KEEL_PERIOD_LIMIT_US;
  @ assigns \nothing;
  @ ensures SPR_004_divisor: \result == common_divisor(a, b);
  @ ensures SPR_004_range: 0 < \result < KEEL_PERIOD_LIMIT_US;
  @*/
uint32_t keel_spread_divisor(uint32_t a, uint32_t b);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler));
  @ requires crowded == \null || \valid(crowded);
  @ requires scheduler != \null && crowded != \null ==> \separated(scheduler, crowded);
  @ assigns scheduler->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1], *crowded;
  @ assigns scheduler->wake_us, scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ behavior null:
  @   assumes scheduler == \null || crowded == \null;
  @   assigns \nothing;
  @   ensures SPR_003_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && crowded != \null && scheduler->stage != KEEL_STAGE_SETUP;
  @   assigns \nothing;
  @   ensures SPR_003_state: \result == KEEL_ERR_STATE;
  @ behavior spread:
  @   assumes scheduler != \null && crowded != \null && scheduler->stage == KEEL_STAGE_SETUP;
  @   ensures ok: \result == KEEL_OK;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SPR_001_phases: phases_only{Pre, Post}(&scheduler->queue);
  @   ensures SPR_001_free: free_untouched{Pre, Post}(&scheduler->queue);
  @   ensures SPR_001_known: nothing_known(scheduler);
  @   ensures SPR_002_crowded: *crowded <= scheduler->queue.count;
  @   ensures SPR_002_apart: *crowded == 0 ==>
  @       \forall integer i, j; 0 <= i < j < scheduler->queue.count ==>
  @           keep_apart(&scheduler->queue, scheduler->queue.order[i], scheduler->queue.order[j],
  @                      scheduler->config.guard_us);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded);

KEEL_C_END

#endif
