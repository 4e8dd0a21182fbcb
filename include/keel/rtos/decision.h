/**
 * @file decision.h
 * @brief Which task runs now: pure functions over the queue, which change nothing.
 *
 * FCFS takes the first due real-time task in queue order (eq. 1). Among the other tasks those are
 * eligible that are released and either fit the slack S, with the scheduler's guard W and the
 * task's worst-case time w (W + w <= S; eq. 2 and 3 with the slack to the next real-time release
 * for t_r), or are promoted. Of these the highest dynamic priority of eq. 3 runs, ties to the one
 * queued first. A promoted task's dynamic priority is the real-time priority, the maximum, so
 * promoted tasks come before all others and among themselves in queue order: first come, first
 * served.
 */
#ifndef KEEL_RTOS_DECISION_H
#define KEEL_RTOS_DECISION_H

#include "keel/rtos/clock.h"
#include "keel/rtos/priority.h"
#include "keel/rtos/queue.h"
#include "keel/rtos/task.h"

#include <stdint.h>

/** The slack when no real-time task is queued, and the wake-up time when there is nothing to do. */
#define KEEL_TIME_NEVER_US UINT64_MAX

/*@ predicate released(keel_task_t *task, integer now_us) = task->release_us <= now_us;
  @
  @ // Time since the release before the one to be served: eq. 3's t - le, on the grid.
  @ logic integer task_age(keel_task_t *task, integer now_us) =
  @     now_us - task->release_us + task->config->period_us;
  @
  @ logic integer task_priority(keel_task_t *task, integer now_us) =
  @     dynamic_priority(task->config->priority, task_age(task, now_us), task->config->period_us);
  @
  @ // w: the declared budget or the longest measured run, whichever is longer.
  @ logic integer task_worst(keel_task_t *task) =
  @     \max(task->config->budget_us, task->stats.longest_us);
  @
  @ predicate promoted(keel_task_t *task, integer now_us) =
  @     task_priority(task, now_us) == KEEL_PRIORITY_REALTIME;
  @
  @ predicate eligible(keel_task_t *task, integer now_us, integer slack_us, integer guard_us) =
  @     released(task, now_us) &&
  @     (promoted(task, now_us) || guard_us + task_worst(task) <= slack_us);
  @
  @ // Time to a task's release, none when it is due.
  @ logic integer time_to(keel_task_t *task, integer now_us) =
  @     (task->release_us > now_us) ? task->release_us - now_us : 0;
  @
  @ predicate decidable(keel_queue_t *q, integer now_us) =
  @     queue_valid(q) && queue_checked(q) && now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @*/

/**
 * FCFS: the first due real-time task in a part of the queue (eq. 1, requirement DEC-001).
 *
 * @param queue  a valid queue
 * @param from   the first index to look at
 * @param to     the index behind the last; from <= to <= queue->realtime_count
 * @param now_us the time, in us
 * @return the index of the first task in the part that is due, or to when none is
 */
/*@ requires \valid_read(queue) && queue_valid(queue);
  @ requires from <= to <= queue->realtime_count;
  @ assigns \nothing;
  @ ensures range: from <= \result <= to;
  @ ensures DEC_001_due: \result < to ==> released(queue->task[\result], now_us);
  @ ensures DEC_001_first: \forall integer i; from <= i < \result ==>
  @     !released(queue->task[i], now_us);
  @*/
uint32_t keel_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                uint64_t now_us);

/**
 * The slack S: the time to the next real-time release (requirement DEC-002).
 *
 * @param queue  a valid queue
 * @param now_us the time, in us
 * @return the time in us, 0 when a real-time task is due, KEEL_TIME_NEVER_US when there is none
 */
/*@ requires \valid_read(queue) && queue_valid(queue);
  @ assigns \nothing;
  @ ensures DEC_002_bound: \forall integer i; 0 <= i < queue->realtime_count ==>
  @     \result <= time_to(queue->task[i], now_us);
  @ ensures DEC_002_exact: \result == KEEL_TIME_NEVER_US ||
  @     (\exists integer i; 0 <= i < queue->realtime_count &&
  @         \result == time_to(queue->task[i], now_us));
  @ ensures DEC_002_none: queue->realtime_count == 0 ==> \result == KEEL_TIME_NEVER_US;
  @*/
uint64_t keel_decision_slack_us(const keel_queue_t *queue, uint64_t now_us);

/**
 * EDF with dynamic priority: the task that runs among those that are not real-time (eq. 3,
 * requirement DEC-003).
 *
 * @param queue    a valid queue of checked tasks
 * @param now_us   the time, in us
 * @param slack_us the slack S, in us
 * @param guard_us the guard W, in us
 * @return the index of the chosen task, or queue->count when none is eligible
 */
/*@ requires \valid_read(queue) && decidable(queue, now_us);
  @ assigns \nothing;
  @ ensures range: queue->realtime_count <= \result <= queue->count;
  @ ensures DEC_003_eligible: \result < queue->count ==>
  @     eligible(queue->task[\result], now_us, slack_us, guard_us);
  @ ensures DEC_003_highest: \result < queue->count ==>
  @     \forall integer i; queue->realtime_count <= i < queue->count ==>
  @         eligible(queue->task[i], now_us, slack_us, guard_us) ==>
  @         task_priority(queue->task[i], now_us) <= task_priority(queue->task[\result], now_us);
  @ ensures DEC_003_first: \result < queue->count ==>
  @     \forall integer i; queue->realtime_count <= i < \result ==>
  @         eligible(queue->task[i], now_us, slack_us, guard_us) ==>
  @         task_priority(queue->task[i], now_us) < task_priority(queue->task[\result], now_us);
  @ ensures DEC_003_none: \result == queue->count ==>
  @     \forall integer i; queue->realtime_count <= i < queue->count ==>
  @         !eligible(queue->task[i], now_us, slack_us, guard_us);
  @*/
uint32_t keel_decision_other(const keel_queue_t *queue, uint64_t now_us, uint64_t slack_us,
                             uint32_t guard_us);

/*@ // When waiting alone can make a task run: its release, or its promotion if it is released.
  @ logic integer next_event(keel_task_t *task, integer now_us) =
  @     (task->release_us > now_us || task->config->priority == KEEL_PRIORITY_REALTIME)
  @         ? task->release_us
  @         : task->release_us - task->config->period_us
  @           + promotion_age(task->config->priority, task->config->period_us);
  @*/

/**
 * How long nothing can become eligible when nothing is now (requirement DEC-004): until the first
 * release, or the promotion of a task that is released but does not fit. Slack only shrinks until
 * a real-time task runs, so a task that does not fit now will not fit before that.
 *
 * @param queue  a valid queue of checked tasks
 * @param now_us the time, in us
 * @return the time up to which every decision is the same, in us, or KEEL_TIME_NEVER_US
 */
/*@ requires \valid_read(queue) && decidable(queue, now_us);
  @ assigns \nothing;
  @ ensures DEC_004_bound: \forall integer i; 0 <= i < queue->count ==>
  @     \result <= next_event(queue->task[i], now_us);
  @ ensures DEC_004_exact: \result == KEEL_TIME_NEVER_US ||
  @     (\exists integer i; 0 <= i < queue->count &&
  @         \result == next_event(queue->task[i], now_us));
  @*/
uint64_t keel_decision_wake_us(const keel_queue_t *queue, uint64_t now_us);

#endif
