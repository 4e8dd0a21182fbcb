/**
 * @file queue.h
 * @brief The one task queue that both halves of the scheduler share: an array without gaps.
 *
 * Slots 0 to count - 1 hold tasks, the others none. Within the array the real-time tasks come
 * first, then the others, each class in the order in which its tasks were added: order matters
 * only within a class (FCFS serves real-time tasks in queue order, EDF breaks ties by it), and
 * with the classes apart neither half of the scheduler looks at the tasks of the other.
 *
 * The queue points at tasks, which belong to its caller, as does the queue itself.
 */
#ifndef KEEL_RTOS_QUEUE_H
#define KEEL_RTOS_QUEUE_H

#include "keel/rtos/task.h"
#include "keel/status.h"

#include <stdint.h>

/** How many tasks a queue holds. */
#ifndef KEEL_QUEUE_CAPACITY
#define KEEL_QUEUE_CAPACITY 32u
#endif

/** The queue. Read it freely; only the functions of the kernel write it. */
typedef struct keel_queue {
    uint32_t count;                         /**< Tasks in the queue. */
    uint32_t realtime_count;                /**< How many of them, at the front, are real-time. */
    keel_task_t *task[KEEL_QUEUE_CAPACITY]; /**< The tasks, then nulls. */
} keel_queue_t;

/*@ predicate queue_counts(keel_queue_t *q) =
  @     q->realtime_count <= q->count <= KEEL_QUEUE_CAPACITY;
  @
  @ predicate queue_no_gaps(keel_queue_t *q) =
  @     (\forall integer i; 0 <= i < q->count ==> q->task[i] != \null) &&
  @     (\forall integer i; q->count <= i < KEEL_QUEUE_CAPACITY ==> q->task[i] == \null);
  @
  @ predicate queue_no_duplicates(keel_queue_t *q) =
  @     \forall integer i, j; 0 <= i < j < q->count ==> q->task[i] != q->task[j];
  @
  @ predicate queue_realtime_first(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->realtime_count ==> realtime(q->task[i]);
  @
  @ predicate queue_others_last(keel_queue_t *q) =
  @     \forall integer i; q->realtime_count <= i < q->count ==> !realtime(q->task[i]);
  @
  @ predicate queue_tasks_valid(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> \valid(q->task[i]);
  @
  @ predicate queue_configs_valid(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> \valid_read(q->task[i]->config);
  @
  @ // The tasks are memory apart from the queue, their declarations objects of their own.
  @ predicate queue_apart(keel_queue_t *q) =
  @     (\forall integer i; 0 <= i < q->count ==> \separated(q, q->task[i])) &&
  @     (\forall integer i; 0 <= i < q->count ==> \base_addr(q) != \base_addr(q->task[i]->config));
  @
  @ predicate queue_valid(keel_queue_t *q) =
  @     queue_counts(q) && queue_no_gaps(q) && queue_no_duplicates(q) && queue_tasks_valid(q) &&
  @     queue_configs_valid(q) && queue_apart(q) && queue_realtime_first(q) &&
  @     queue_others_last(q);
  @
  @ // Each task's declaration has passed keel_task_check.
  @ predicate queue_checked(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < q->count ==> config_valid(q->task[i]->config);
  @
  @ predicate queue_holds(keel_queue_t *q, keel_task_t *task) =
  @     \exists integer i; 0 <= i < q->count && q->task[i] == task;
  @
  @ // Slots first to last - 1 hold in state M what they held in state L.
  @ predicate slots_same{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->task[i], M) == \at(q->task[i], L);
  @
  @ // Slots first to last - 1 hold in state M what the slots before them held in state L.
  @ predicate slots_down{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->task[i], M) == \at(q->task[i - 1], L);
  @
  @ // Slots first to last - 1 hold in state M what the slots behind them held in state L.
  @ predicate slots_up{L, M}(keel_queue_t *q, integer first, integer last) =
  @     \forall integer i; first <= i < last ==> \at(q->task[i], M) == \at(q->task[i + 1], L);
  @
  @ // Where add puts a task: behind the last of its class.
  @ logic integer queue_place(keel_queue_t *q, keel_task_t *task) =
  @     (task->config->priority == KEEL_PRIORITY_REALTIME) ? q->realtime_count : q->count;
  @*/

/**
 * Makes a queue empty (requirement QUE-001).
 *
 * @param queue the queue to initialise
 */
/*@ requires \valid(queue);
  @ assigns queue->count, queue->realtime_count, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures QUE_001: queue_valid(queue) && queue->count == 0;
  @*/
void keel_queue_init(keel_queue_t *queue);

/**
 * Finds a task (requirement QUE-002).
 *
 * @param queue a valid queue
 * @param task  the task to look for; it is compared, never read
 * @return its index, or queue->count when it is not there
 */
/*@ requires \valid_read(queue) && queue_valid(queue);
  @ assigns \nothing;
  @ ensures range: \result <= queue->count;
  @ ensures QUE_002_found: \result < queue->count ==> queue->task[\result] == task;
  @ ensures QUE_002_absent: \result == queue->count ==> !queue_holds(queue, task);
  @*/
uint32_t keel_queue_find(const keel_queue_t *queue, keel_task_t *task);

/**
 * Adds a task behind the last of its class (requirement QUE-003). Writes the queue alone.
 *
 * @param queue a valid queue
 * @param task  the task, with its declaration set; both must outlive its stay in the queue
 * @return KEEL_OK, KEEL_ERR_NULL, KEEL_ERR_DUPLICATE or KEEL_ERR_FULL, tested in this order
 */
/*@ requires \valid(queue) && queue_valid(queue);
  @ requires task == \null || (\valid(task) && \valid_read(task->config) &&
  @     \separated(queue, task) && \base_addr(queue) != \base_addr(task->config));
  @ assigns queue->count, queue->realtime_count, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures QUE_005_counts: queue_counts(queue);
  @ ensures QUE_005_no_gaps: queue_no_gaps(queue);
  @ ensures QUE_005_no_duplicates: queue_no_duplicates(queue);
  @ ensures QUE_005_tasks: queue_tasks_valid(queue);
  @ ensures QUE_005_configs: queue_configs_valid(queue);
  @ ensures QUE_005_apart: queue_apart(queue);
  @ ensures QUE_005_realtime: queue_realtime_first(queue);
  @ ensures QUE_005_others: queue_others_last(queue);
  @ behavior null:
  @   assumes task == \null;
  @   assigns \nothing;
  @   ensures QUE_004_null: \result == KEEL_ERR_NULL;
  @ behavior duplicate:
  @   assumes task != \null && queue_holds(queue, task);
  @   assigns \nothing;
  @   ensures QUE_004_duplicate: \result == KEEL_ERR_DUPLICATE;
  @ behavior full:
  @   assumes task != \null && !queue_holds(queue, task);
  @   assumes queue->count == KEEL_QUEUE_CAPACITY;
  @   assigns \nothing;
  @   ensures QUE_004_full: \result == KEEL_ERR_FULL;
  @ behavior added:
  @   assumes task != \null && !queue_holds(queue, task);
  @   assumes queue->count < KEEL_QUEUE_CAPACITY;
  @   assigns queue->count, queue->realtime_count, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @   ensures ok: \result == KEEL_OK;
  @   ensures QUE_003_count: queue->count == \old(queue->count) + 1;
  @   ensures QUE_003_realtime: queue->realtime_count == \old(queue->realtime_count)
  @       + ((task->config->priority == KEEL_PRIORITY_REALTIME) ? 1 : 0);
  @   ensures QUE_003_place: queue->task[\old(queue_place(queue, task))] == task;
  @   ensures QUE_006_before: slots_same{Pre, Post}(queue, 0, \old(queue_place(queue, task)));
  @   ensures QUE_006_behind:
  @       slots_down{Pre, Post}(queue, \old(queue_place(queue, task)) + 1, queue->count);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_queue_add(keel_queue_t *queue, keel_task_t *task);

/**
 * Removes the task at an index; those behind it move up one slot (requirement QUE-007).
 *
 * @param queue a valid queue
 * @param index the task's index, as keel_queue_find gave it
 * @return KEEL_OK, or KEEL_ERR_UNKNOWN_TASK when no task has this index
 */
/*@ requires \valid(queue) && queue_valid(queue);
  @ assigns queue->count, queue->realtime_count, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures QUE_005_counts: queue_counts(queue);
  @ ensures QUE_005_no_gaps: queue_no_gaps(queue);
  @ ensures QUE_005_no_duplicates: queue_no_duplicates(queue);
  @ ensures QUE_005_tasks: queue_tasks_valid(queue);
  @ ensures QUE_005_configs: queue_configs_valid(queue);
  @ ensures QUE_005_apart: queue_apart(queue);
  @ ensures QUE_005_realtime: queue_realtime_first(queue);
  @ ensures QUE_005_others: queue_others_last(queue);
  @ behavior unknown:
  @   assumes index >= queue->count;
  @   assigns \nothing;
  @   ensures QUE_004_unknown: \result == KEEL_ERR_UNKNOWN_TASK;
  @ behavior removed:
  @   assumes index < queue->count;
  @   assigns queue->count, queue->realtime_count, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @   ensures ok: \result == KEEL_OK;
  @   ensures QUE_007_gone: !queue_holds(queue, \old(queue->task[index]));
  @   ensures QUE_007_count: queue->count == \old(queue->count) - 1;
  @   ensures QUE_007_realtime: queue->realtime_count == \old(queue->realtime_count)
  @       - ((index < \old(queue->realtime_count)) ? 1 : 0);
  @   ensures QUE_008_before: slots_same{Pre, Post}(queue, 0, index);
  @   ensures QUE_008_behind: slots_up{Pre, Post}(queue, index, queue->count);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_queue_remove(keel_queue_t *queue, uint32_t index);

#endif
