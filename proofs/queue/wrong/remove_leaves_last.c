// harness: keel_queue_remove_harness
// expect: QUE_005_no_gaps
//
// remove moves the tasks up, but leaves the last one behind the end as well.
#include "keel/rtos/queue.h"

void keel_queue_init(keel_queue_t *queue)
{
    queue->count = 0u;
    queue->realtime_count = 0u;
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        queue->task[i] = NULL;
    }
}

/* MISRA deviation MD-005: the prover needs the task as a pointer that is not const. */
uint32_t keel_queue_find(const keel_queue_t *queue, keel_task_t *task)
{
    uint32_t i = 0u;

    while ((i < queue->count) && (queue->task[i] != task)) {
        i++;
    }
    return i;
}

/* Moves slots place to count - 1 down by one, which frees slot place. */
static void open_slot(keel_queue_t *queue, uint32_t place)
{
    for (uint32_t i = queue->count; i > place; i--) {
        queue->task[i] = queue->task[i - 1u];
    }
}

/* Moves slots place + 1 to count - 1 up by one, over slot place. */
static void close_slot(keel_queue_t *queue, uint32_t place)
{
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
    queue->task[place] = task;
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
    queue->count--;
    if (index < queue->realtime_count) {
        queue->realtime_count--;
    }
    return KEEL_OK;
}
