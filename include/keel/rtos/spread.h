/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spread.h
 * @brief First releases that keep the tasks out of each other's way, found by the kernel itself.
 *
 * Tasks that are released together wait for each other, and start late by turns: that is most of
 * the jitter of a set without phases. Here each task gets the first phase at which it meets no
 * other one, for sets whose phases nobody has worked out (`make analyze ARGS=--phases` does).
 *
 *     keel_scheduler_add(&s, &gyro);        for every task
 *     keel_scheduler_spread(&s, &crowded);  once, behind the last of them
 *     keel_scheduler_start(&s);
 *
 * Two tasks never meet if their releases, modulo the greatest common divisor of their periods, are
 * far enough apart in both directions: by the earlier one's budget, the guard W and a tick of the
 * clock. That is what eq. 2 asks for before a real-time release. Before any other release it leaves
 * time for the decision behind a run, which the guard stands for.
 *
 * Periods with a small common divisor leave little room: 1000 us and 1001 us none at all.
 */
#ifndef KEEL_RTOS_SPREAD_H
#define KEEL_RTOS_SPREAD_H

#include "keel/c_declarations.h"
#include "keel/rtos/queue.h"
#include "keel/rtos/scheduler_state.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** How often the tasks placed before are gone through to place one more, at most. */
#ifndef KEEL_SPREAD_ROUNDS_MAX
#define KEEL_SPREAD_ROUNDS_MAX 32u
#endif

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

/**
 * The greatest common divisor of two times (requirement SPR-004): two periods come together again
 * and again at every multiple of it.
 *
 * @param a more than 0 and below 2^31
 * @param b below 2^31; of 0 and a it is a
 * @return what divides both
 */
/*@ requires 0 < a < KEEL_PERIOD_LIMIT_US && b < KEEL_PERIOD_LIMIT_US;
  @ assigns \nothing;
  @ ensures SPR_004_divisor: \result == common_divisor(a, b);
  @ ensures SPR_004_range: 0 < \result < KEEL_PERIOD_LIMIT_US;
  @*/
uint32_t keel_spread_divisor(uint32_t a, uint32_t b);

/**
 * Sets the first releases of the tasks so that they do not meet (requirements SPR-001 and SPR-002).
 *
 * The tasks are placed one after the other: the real-time ones in queue order, then the others by
 * period, the shortest first, equal ones in queue order. Each gets the first phase below its period
 * at which it keeps apart from all that are placed. One for which there is none, or none is found
 * in KEEL_SPREAD_ROUNDS_MAX rounds, keeps the phase that it declares, and no other heeds it.
 *
 * @param scheduler a scheduler that was not started yet
 * @param crowded   receives how many tasks keep the phase that they declare; 0: no two ever meet,
 *                  as long as budgets are kept and decisions take no longer than the guard
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE after the start
 */
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
