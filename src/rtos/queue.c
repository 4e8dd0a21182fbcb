#include "keel/rtos/queue.h"

/*@ // Writing the queue's slots leaves the tasks' declarations where they were.
  @ predicate configs_same{L, M}(keel_queue_t *q) =
  @     \forall integer i; 0 <= i < \at(q->count, L) ==>
  @         \at(\at(q->task[i], L)->config, M) == \at(q->task[i]->config, L);
  @*/

void keel_queue_init(keel_queue_t *queue)
{
    queue->count = 0u;
    queue->realtime_count = 0u;
    /*@ loop invariant range: 0 <= i <= KEEL_QUEUE_CAPACITY;
      @ loop invariant empty: \forall integer j; 0 <= j < i ==> queue->task[j] == \null;
      @ loop assigns i, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant KEEL_QUEUE_CAPACITY - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        queue->task[i] = NULL;
    }
}

/* MISRA deviation MD-005: the prover needs the task as a pointer that is not const. */
uint32_t keel_queue_find(const keel_queue_t *queue, keel_task_t *task)
{
    uint32_t i = 0u;

    /*@ loop invariant range: 0 <= i <= queue->count;
      @ loop invariant absent: \forall integer j; 0 <= j < i ==> queue->task[j] != task;
      @ loop assigns i;
      @ loop variant queue->count - i;
      @*/
    while ((i < queue->count) && (queue->task[i] != task)) {
        i++;
    }
    return i;
}

/* Moves slots place to count - 1 down by one, which frees slot place. */
/*@ requires \valid(queue) && queue_counts(queue);
  @ requires place <= queue->count < KEEL_QUEUE_CAPACITY;
  @ assigns queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures before: slots_same{Pre, Post}(queue, 0, place);
  @ ensures moved: slots_down{Pre, Post}(queue, place + 1, queue->count + 1);
  @ ensures behind: slots_same{Pre, Post}(queue, queue->count + 1, KEEL_QUEUE_CAPACITY);
  @*/
static void open_slot(keel_queue_t *queue, uint32_t place)
{
    /*@ loop invariant range: place <= i <= queue->count;
      @ loop invariant unmoved: slots_same{Pre, Here}(queue, 0, i);
      @ loop invariant moved: slots_down{Pre, Here}(queue, i + 1, queue->count + 1);
      @ loop invariant behind: slots_same{Pre, Here}(queue, queue->count + 1, KEEL_QUEUE_CAPACITY);
      @ loop assigns i, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant i;
      @*/
    for (uint32_t i = queue->count; i > place; i--) {
        queue->task[i] = queue->task[i - 1u];
    }
}

/* Moves slots place + 1 to count - 1 up by one, over slot place. */
/*@ requires \valid(queue) && queue_counts(queue);
  @ requires place < queue->count;
  @ assigns queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures before: slots_same{Pre, Post}(queue, 0, place);
  @ ensures moved: slots_up{Pre, Post}(queue, place, queue->count - 1);
  @ ensures behind: slots_same{Pre, Post}(queue, queue->count, KEEL_QUEUE_CAPACITY);
  @*/
static void close_slot(keel_queue_t *queue, uint32_t place)
{
    /*@ loop invariant range: place <= i < queue->count;
      @ loop invariant before: slots_same{Pre, Here}(queue, 0, place);
      @ loop invariant moved: slots_up{Pre, Here}(queue, place, i);
      @ loop invariant unmoved: slots_same{Pre, Here}(queue, i, KEEL_QUEUE_CAPACITY);
      @ loop assigns i, queue->task[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant queue->count - i;
      @*/
    for (uint32_t i = place; (i + 1u) < queue->count; i++) {
        queue->task[i] = queue->task[i + 1u];
    }
}

keel_status_t keel_queue_add(keel_queue_t *queue, keel_task_t *task)
{
    uint32_t place;

    if (task == NULL) {
        return KEEL_ERR_NULL;
    }
    if (keel_queue_find(queue, task) < queue->count) {
        return KEEL_ERR_DUPLICATE;
    }
    if (queue->count == KEEL_QUEUE_CAPACITY) {
        return KEEL_ERR_FULL;
    }
    place = keel_task_is_realtime(task) ? queue->realtime_count : queue->count;
    open_slot(queue, place);
    //@ assert apart: configs_same{Pre, Here}(queue);
    queue->task[place] = task;
    //@ assert apart: configs_same{Pre, Here}(queue);
    //@ assert apart_task: task->config == \at(task->config, Pre);
    queue->count++;
    if (keel_task_is_realtime(task)) {
        queue->realtime_count++;
    }
    return KEEL_OK;
}

keel_status_t keel_queue_remove(keel_queue_t *queue, uint32_t index)
{
    if (index >= queue->count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    close_slot(queue, index);
    //@ assert apart: configs_same{Pre, Here}(queue);
    queue->count--;
    queue->task[queue->count] = NULL;
    //@ assert apart: configs_same{Pre, Here}(queue);
    if (index < queue->realtime_count) {
        queue->realtime_count--;
    }
    return KEEL_OK;
}
