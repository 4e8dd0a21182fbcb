/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/decision.h
 * @brief The task that runs now: pure functions over the queue, which change nothing.
 *
 * FCFS takes the first due real-time task in queue order (eq. 1). Among the other tasks those are
 * eligible that are released and either fit the slack S, with the scheduler's guard W and the
 * task's worst-case time w (W + w <= S; eq. 2 and 3 with the slack to the next real-time release
 * for t_r), or are promoted. Of these the highest dynamic priority of eq. 3 runs, ties to the one
 * queued first. A promoted task's dynamic priority is the real-time priority, the maximum, so
 * promoted tasks come before all others and among themselves in queue order: first come, first
 * served.
 *
 * Without promotion only those are eligible that fit the slack, in the same order.
 */
#ifndef KEEL_INTERNAL_RTOS_DECISION_H
#define KEEL_INTERNAL_RTOS_DECISION_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/priority.h"
#include "keel/internal/rtos/queue.h"
#include "keel/rtos/clock.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/*@ // The words of scheduling for the task in slot x.
  @ predicate released(keel_queue_t *q, integer x, integer now_us) = q->release_us[x] <= now_us;
  @
  @ // Eq. 3; a task's age counts from the release before the one to be served, on the grid.
  @ logic integer task_priority(keel_queue_t *q, integer x, integer now_us) =
  @     dynamic_priority(q->priority[x], now_us - q->release_us[x] + q->period_us[x],
  @                      q->period_us[x]);
  @
  @ predicate promoted(keel_queue_t *q, integer x, integer now_us) =
  @     task_priority(q, x, now_us) == KEEL_PRIORITY_REALTIME;
  @
  @ // w: the declared budget or the longest overrun that is remembered, whichever is longer.
  @ logic integer task_worst(keel_queue_t *q, integer x) =
  @     stats_worst(q->budget_us[x], q->stats[x].remembered_us);
  @
  @ // Time to a task's release, none when it is due.
  @ logic integer time_to(keel_queue_t *q, integer x, integer now_us) =
  @     (q->release_us[x] > now_us) ? q->release_us[x] - now_us : 0;
  @
  @ // W + w <= S, the slack being the time to the next of all real-time releases.
  @ predicate fits_slack(keel_queue_t *q, integer x, integer now_us, integer guard_us) =
  @     \forall integer j; 0 <= j < q->realtime_count ==>
  @         guard_us + task_worst(q, x) <= time_to(q, q->order[j], now_us);
  @
  @ // Whether a task may run that is not real-time, if no real-time task is due; without is 0
  @ // where tasks are promoted.
  @ predicate may_run(keel_queue_t *q, integer x, integer now_us, integer guard_us,
  @                   integer without) =
  @     released(q, x, now_us) &&
  @     ((without == 0 && promoted(q, x, now_us)) || fits_slack(q, x, now_us, guard_us));
  @
  @ // The same with the room that the slack leaves beside the guard, which is computed once.
  @ predicate eligible(keel_queue_t *q, integer x, integer now_us, integer room_us,
  @                    integer without) =
  @     released(q, x, now_us) &&
  @     ((without == 0 && promoted(q, x, now_us)) || task_worst(q, x) <= room_us);
  @
  @ // When waiting alone makes a task run that is not real-time: its release, or its promotion, if
  @ // there is any.
  @ logic integer promotion(keel_queue_t *q, integer x) =
  @     q->release_us[x] - q->period_us[x] + promotion_age(q->priority[x], q->period_us[x]);
  @
  @ logic integer next_event(keel_queue_t *q, integer x, integer now_us, integer without) =
  @     (q->release_us[x] > now_us) ? q->release_us[x]
  @         : ((without == 0) ? promotion(q, x) : KEEL_TIME_NEVER_US);
  @
  @ // The earliest release among positions first to last - 1; later than any time if there is none.
  @ predicate is_earliest(keel_queue_t *q, integer first, integer last, integer time_us) =
  @     (\forall integer i; first <= i < last ==> time_us <= q->release_us[q->order[i]]) &&
  @     (time_us == KEEL_TIME_NEVER_US ||
  @      (\exists integer i; first <= i < last && time_us == q->release_us[q->order[i]]));
  @*/

/**
 * FCFS: the first due real-time task in a part of the queue (eq. 1, requirement DEC-001).
 *
 * @param queue  a valid queue
 * @param from   the first position to look at
 * @param to     the position behind the last; from <= to <= queue->realtime_count
 * @param now_us the time, in us
 * @return the position of the first task in the part that is due, or to when none is
 */
/*@ requires \valid_read(queue) && queue_counts(queue) && queue_order(queue);
  @ requires from <= to <= queue->realtime_count;
  @ assigns \nothing;
  @ ensures range: from <= \result <= to;
  @ ensures DEC_001_due: \result < to ==> released(queue, queue->order[\result], now_us);
  @ ensures DEC_001_first: \forall integer i; from <= i < \result ==>
  @     !released(queue, queue->order[i], now_us);
  @*/
uint32_t keel_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                uint64_t now_us);

/**
 * The earliest release of a real-time task, which the slack reaches to (requirement DEC-002).
 *
 * @param queue a valid queue
 * @return the time in us, KEEL_TIME_NEVER_US when there is no real-time task
 */
/*@ requires \valid_read(queue) && queue_counts(queue) && queue_order(queue);
  @ assigns \nothing;
  @ ensures DEC_002_earliest: is_earliest(queue, 0, queue->realtime_count, \result);
  @*/
uint64_t keel_decision_earliest_us(const keel_queue_t *queue);

/**
 * The room for another task: the longest worst-case time w with which W + w <= S, S being the
 * time to the earliest real-time release (requirement DEC-005). Inline, as it is a part of every
 * choice and smaller than a call.
 *
 * @param earliest_us the earliest real-time release, in us
 * @param now_us      the time, in us
 * @param guard_us    the guard W, in us
 * @return the room in us, UINT32_MAX when it is longer; 0 when even a task of 1 us does not fit
 */
/*@ assigns \nothing;
  @ ensures DEC_005_room: \forall integer w; 0 < w <= UINT32_MAX ==>
  @     (w <= \result <==>
  @      guard_us + w <= ((earliest_us > now_us) ? earliest_us - now_us : 0));
  @*/
static inline uint32_t keel_decision_room_us(uint64_t earliest_us, uint64_t now_us,
                                             uint32_t guard_us)
{
    uint64_t room_us;

    if ((earliest_us <= now_us) || ((earliest_us - now_us) <= guard_us)) {
        return 0u;
    }
    room_us = (earliest_us - now_us) - guard_us;
    return (room_us < UINT32_MAX) ? (uint32_t)room_us : UINT32_MAX;
}

/** The task that runs of those that are not real-time, and when the next of them is released. */
typedef struct keel_choice {
    uint64_t earliest_us; /**< The earliest release of them all; KEEL_TIME_NEVER_US if none is. */
    uint32_t position;    /**< The chosen task's position in the order; 0 when there is none. */
    uint32_t priority;    /**< Its dynamic priority; 0: none is eligible. */
} keel_choice_t;

/*@ // A choice at now_us follows from what each of the tasks was allowed then.
  @ predicate chosen(keel_queue_t *q, keel_choice_t c, integer now_us, integer room_us,
  @                  integer without) =
  @     q->realtime_count <= c.position < q->count &&
  @     eligible(q, q->order[c.position], now_us, room_us, without) &&
  @     c.priority == task_priority(q, q->order[c.position], now_us);
  @*/

/**
 * EDF with dynamic priority: the task that runs among those that are not real-time (eq. 3,
 * requirement DEC-003).
 *
 * @param queue             a valid queue
 * @param now_us            the time, in us
 * @param room_us           the room that the slack leaves, in us (keel_decision_room_us)
 * @param without_promotion whether only those run that fit the room
 * @return the choice
 */
/*@ requires \valid_read(queue) && queue_valid(queue);
  @ requires now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns \nothing;
  @ ensures range: \result.priority <= KEEL_PRIORITY_REALTIME;
  @ ensures DEC_003_earliest:
  @     is_earliest(queue, queue->realtime_count, queue->count, \result.earliest_us);
  @ ensures DEC_003_eligible: \result.priority > 0 ==>
  @     chosen(queue, \result, now_us, room_us, without_promotion);
  @ ensures DEC_003_highest: \forall integer i; queue->realtime_count <= i < queue->count ==>
  @     eligible(queue, queue->order[i], now_us, room_us, without_promotion) ==>
  @     task_priority(queue, queue->order[i], now_us) <= \result.priority;
  @ ensures DEC_003_first: \result.priority > 0 ==>
  @     \forall integer i; queue->realtime_count <= i < \result.position ==>
  @     eligible(queue, queue->order[i], now_us, room_us, without_promotion) ==>
  @     task_priority(queue, queue->order[i], now_us) < \result.priority;
  @ ensures DEC_003_none: \result.priority == 0 ==>
  @     \forall integer i; queue->realtime_count <= i < queue->count ==>
  @     !eligible(queue, queue->order[i], now_us, room_us, without_promotion);
  @ ensures DEC_003_nowhere: \result.priority == 0 ==> \result.position == 0;
  @*/
keel_choice_t keel_decision_other(const keel_queue_t *queue, uint64_t now_us, uint32_t room_us,
                                  bool without_promotion);

/**
 * How long no task that is not real-time can become eligible when none is now (requirement
 * DEC-004): until the first release, or the promotion of a task that is released but does not fit.
 * Slack only shrinks until a real-time task runs, so what does not fit now will not before that.
 *
 * @param queue             a valid queue
 * @param now_us            the time, in us
 * @param without_promotion whether no task is ever promoted
 * @return the earliest such time in us, or KEEL_TIME_NEVER_US
 */
/*@ requires \valid_read(queue) && queue_valid(queue);
  @ requires now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns \nothing;
  @ ensures DEC_004_bound: \forall integer i; queue->realtime_count <= i < queue->count ==>
  @     \result <= next_event(queue, queue->order[i], now_us, without_promotion);
  @ ensures DEC_004_exact: \result == KEEL_TIME_NEVER_US ||
  @     (\exists integer i; queue->realtime_count <= i < queue->count &&
  @         \result == next_event(queue, queue->order[i], now_us, without_promotion));
  @*/
uint64_t keel_decision_event_us(const keel_queue_t *queue, uint64_t now_us, bool without_promotion);

KEEL_C_END

#endif
