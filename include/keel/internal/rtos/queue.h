/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/queue.h
 * @brief The functions of queue.h, which the kernel alone calls, and their contracts.
 *
 * They ask for what their caller has checked, and refuse nothing.
 */
#ifndef KEEL_INTERNAL_RTOS_QUEUE_H
#define KEEL_INTERNAL_RTOS_QUEUE_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/priority.h"
#include "keel/internal/rtos/stats.h"
#include "keel/internal/rtos/task.h"
#include "keel/rtos/queue.h"

KEEL_C_BEGIN

/*@ predicate queue_counts(keel_queue_t *q) =
  @     q->realtime_count <= q->count <= KEEL_QUEUE_CAPACITY;
  @
  @ // Every slot stands in the order, once.
  @ predicate queue_order(keel_queue_t *q) =
  @     (\forall integer i; 0 <= i < KEEL_QUEUE_CAPACITY ==> q->order[i] < KEEL_QUEUE_CAPACITY) &&
  @     (\forall integer i, j; 0 <= i < j < KEEL_QUEUE_CAPACITY ==> q->order[i] != q->order[j]);
  @
  @ predicate queue_no_gaps(keel_queue_t *q) =
  @     (\forall integer i; 0 <= i < q->count ==> q->task[q->order[i]] != \null) &&
  @     (\forall integer i; q->count <= i < KEEL_QUEUE_CAPACITY ==>
  @         q->task[q->order[i]] == \null);
  @
  @ predicate queue_no_duplicates(keel_queue_t *q) =
  @     \forall integer i, j; 0 <= i < j < q->count ==>
  @         q->task[q->order[i]] != q->task[q->order[j]];
  @
  @ predicate queue_realtime_first(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->realtime_count ==>
  @         q->priority[q->order[i]] == KEEL_PRIORITY_REALTIME;
  @
  @ predicate queue_others_last(keel_queue_t *q) =
  @     \forall integer i; q->realtime_count <= i < q->count ==>
  @         1 <= q->priority[q->order[i]] <= KEEL_PRIORITY_HIGH;
  @
  @ predicate queue_periods(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> period_valid(q->period_us[q->order[i]]);
  @
  @ predicate queue_budgets(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> 0 < q->budget_us[q->order[i]];
  @
  @ predicate queue_valid(keel_queue_t *q) =
  @     queue_counts(q) && queue_order(q) && queue_no_gaps(q) && queue_no_duplicates(q) &&
  @     queue_realtime_first(q) && queue_others_last(q) && queue_periods(q) && queue_budgets(q);
  @
  @ predicate queue_holds(keel_queue_t *q, keel_task_config_t *task) =
  @     \exists integer i; 0 <= i < q->count && q->task[q->order[i]] == task;
  @
  @ // Positions first to last - 1 hold in state M the slots that they held in state L ...
  @ predicate order_same{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->order[i], M) == \at(q->order[i], L);
  @
  @ // ... those that the positions before them held ...
  @ predicate order_down{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->order[i], M) == \at(q->order[i - 1], L);
  @
  @ // ... or those that the positions behind them held.
  @ predicate order_up{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->order[i], M) == \at(q->order[i + 1], L);
  @
  @ // The whole periods that a task in slot x has missed, and the point of its grid behind now.
  @ logic integer grid_missed(keel_queue_t *q, integer x, integer now_us) =
  @     (now_us - q->release_us[x]) / q->period_us[x];
  @
  @ logic integer grid_next(keel_queue_t *q, integer x, integer now_us) =
  @     q->release_us[x] + (grid_missed(q, x, now_us) + 1) * q->period_us[x];
  @
  @ // Where add puts a task: behind the last of its class.
  @ logic integer queue_place(keel_queue_t *q, integer priority) =
  @     (priority == KEEL_PRIORITY_REALTIME) ? q->realtime_count : q->count;
  @
  @ // From state L to M a task of this priority has joined the order at its place, in the first
  @ // free slot.
  @ predicate order_joined{L, M}(keel_queue_t *q, integer priority) =
  @     \at(q->count, M) == \at(q->count, L) + 1 &&
  @     \at(q->realtime_count, M) == \at(q->realtime_count, L)
  @         + ((priority == KEEL_PRIORITY_REALTIME) ? 1 : 0) &&
  @     \at(q->order[\at(queue_place(q, priority), L)], M) == \at(q->order[q->count], L) &&
  @     order_same{L, M}(q, 0, \at(queue_place(q, priority), L)) &&
  @     order_down{L, M}(q, \at(queue_place(q, priority), L) + 1, \at(q->count, M)) &&
  @     order_same{L, M}(q, \at(q->count, M), KEEL_QUEUE_CAPACITY);
  @
  @ // From state L to M the task at position i has left the order; its slot is the first free one.
  @ predicate order_left{L, M}(keel_queue_t *q, integer i) =
  @     \at(q->count, M) == \at(q->count, L) - 1 &&
  @     \at(q->realtime_count, M) == \at(q->realtime_count, L)
  @         - ((i < \at(q->realtime_count, L)) ? 1 : 0) &&
  @     order_same{L, M}(q, 0, i) && order_up{L, M}(q, i, \at(q->count, M)) &&
  @     \at(q->order[q->count], M) == \at(q->order[i], L) &&
  @     order_same{L, M}(q, \at(q->count, L), KEEL_QUEUE_CAPACITY);
  @
  @ // Slot x holds what scheduling reads of a task's declaration.
  @ predicate slot_copied(keel_queue_t *q, integer x, keel_task_config_t *task) =
  @     q->task[x] == task && q->period_us[x] == task->period_us &&
  @     q->budget_us[x] == task->budget_us && q->priority[x] == task->priority;
  @*/

/* clang-format off: the formatter does not know these clauses. */
/* The invariant of a queue as one clause for each part, which provers take one at a time. */
#define QUEUE_STAYS_VALID(q)                                                                       \
    ensures QUE_005_counts : queue_counts(q);                                                      \
    ensures QUE_005_order : queue_order(q);                                                        \
    ensures QUE_005_no_gaps : queue_no_gaps(q);                                                    \
    ensures QUE_005_no_duplicates : queue_no_duplicates(q);                                        \
    ensures QUE_005_realtime : queue_realtime_first(q);                                            \
    ensures QUE_005_others : queue_others_last(q);                                                 \
    ensures QUE_005_periods : queue_periods(q);                                                    \
    ensures QUE_005_budgets : queue_budgets(q);

/* All that is kept of the task in a slot. */
#define QUEUE_SLOT(q, x)                                                                           \
    (q)->task[x], (q)->release_us[x], (q)->period_us[x], (q)->budget_us[x], (q)->priority[x],      \
        (q)->skipped[x], STATS_FIELDS((q)->stats[x])

/* The counts of a task that was just added. */
#define SLOT_FRESH(q, x) ((q)->skipped[x] == 0 && STATS_FRESH((q)->stats[x]))
/* clang-format on */

/**
 * Makes a queue empty (requirement QUE-001).
 *
 * @param queue the queue to initialise
 */
/*@ requires \valid(queue);
  @ assigns queue->count, queue->realtime_count, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures QUE_001_valid: queue_valid(queue);
  @ ensures QUE_001_empty: queue->count == 0 && queue->realtime_count == 0;
  @*/
void keel_queue_init(keel_queue_t *queue);

/**
 * Finds a task (requirement QUE-002).
 *
 * @param queue a valid queue
 * @param task  the task to look for; it is compared, never read
 * @return its position in the order, or queue->count when it is not there
 */
/*@ requires \valid_read(queue) && queue_counts(queue) && queue_order(queue);
  @ assigns \nothing;
  @ ensures range: \result <= queue->count;
  @ ensures QUE_002_found: \result < queue->count ==>
  @     queue->task[queue->order[\result]] == task;
  @ ensures QUE_002_absent: \forall integer i; 0 <= i < \result ==>
  @     queue->task[queue->order[i]] != task;
  @*/
uint32_t keel_queue_find(const keel_queue_t *queue, const keel_task_config_t *task);

/**
 * Adds a task behind the last of its class: copies what scheduling reads of its declaration, sets
 * its first release and clears its statistics (requirement QUE-003).
 *
 * @param queue      a valid queue with a free slot, without the task
 * @param task       the task, whose declaration keel_task_check accepts; it must outlive its stay
 * @param release_us its first release, in us
 */
/*@ requires \valid(queue) && queue_valid(queue) && queue->count < KEEL_QUEUE_CAPACITY;
  @ requires \valid_read(task) && \separated(queue, task) && config_valid(task);
  @ requires !queue_holds(queue, task);
  @ assigns queue->count, queue->realtime_count, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns QUEUE_SLOT(queue, queue->order[queue->count]);
  @ QUEUE_STAYS_VALID(queue)
  @ ensures QUE_003_order: order_joined{Pre, Post}(queue, task->priority);
  @ ensures QUE_003_copied: slot_copied(queue, \old(queue->order[queue->count]), task);
  @ ensures QUE_003_fresh: SLOT_FRESH(queue, \old(queue->order[queue->count]));
  @ ensures QUE_003_release: queue->release_us[\old(queue->order[queue->count])] == release_us;
  @*/
void keel_queue_add(keel_queue_t *queue, const keel_task_config_t *task, uint64_t release_us);

/**
 * Takes the task at a position out of the queue; those behind it move up by one (requirement
 * QUE-007).
 *
 * @param queue    a valid queue
 * @param position of a task in the order, below queue->count
 */
/*@ requires \valid(queue) && queue_valid(queue) && position < queue->count;
  @ assigns queue->count, queue->realtime_count, queue->order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns queue->task[queue->order[position]];
  @ QUEUE_STAYS_VALID(queue)
  @ ensures QUE_007_gone: !queue_holds(queue, \old(queue->task[queue->order[position]]));
  @ ensures QUE_007_order: order_left{Pre, Post}(queue, position);
  @ ensures QUE_007_freed: queue->task[\old(queue->order[position])] == \null;
  @*/
void keel_queue_remove(keel_queue_t *queue, uint32_t position);

/**
 * Moves a released task's release on to the first point of its grid behind the present, and counts
 * the whole periods that were missed (requirement QUE-009). The grid never shifts, so the task does
 * not drift however late it runs.
 *
 * @param queue  a queue
 * @param slot   the slot of a task that is due
 * @param now_us the time, not before the task's release, in us
 */
/*@ requires \valid(queue) && slot < KEEL_QUEUE_CAPACITY;
  @ requires period_valid(queue->period_us[slot]);
  @ requires queue->release_us[slot] <= now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns queue->release_us[slot], queue->skipped[slot];
  @ ensures QUE_009_grid: queue->release_us[slot] == \old(grid_next(queue, slot, now_us));
  @ ensures QUE_009_next:
  @     now_us < queue->release_us[slot] <= now_us + queue->period_us[slot];
  @ ensures QUE_009_on_time: now_us < \old(queue->release_us[slot]) + queue->period_us[slot] ==>
  @     queue->release_us[slot] == \old(queue->release_us[slot]) + queue->period_us[slot] &&
  @     queue->skipped[slot] == \old(queue->skipped[slot]);
  @ ensures QUE_009_skipped: queue->skipped[slot] ==
  @     \min(UINT16_MAX, \old(queue->skipped[slot] + grid_missed(queue, slot, now_us)));
  @*/
void keel_queue_advance(keel_queue_t *queue, uint32_t slot, uint64_t now_us);

KEEL_C_END

#endif
