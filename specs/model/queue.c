/* SPDX-License-Identifier: Apache-2.0 */
#include "queue.h"

#include <stdbool.h>
#include <stddef.h>

void model_queue_init(keel_queue_t *queue)
{
    /* QUE-001: no task; every slot is free, and has a place in the order. */
    queue->count = 0u;
    queue->realtime_count = 0u;
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        queue->order[i] = (uint8_t)i;
        queue->task[i] = NULL;
    }
}

uint32_t model_queue_find(const keel_queue_t *queue, const keel_task_config_t *task)
{
    uint32_t position = queue->count; /* QUE-002: when it is not there */

    for (uint32_t i = KEEL_QUEUE_CAPACITY; i > 0u; i--) {
        if (((i - 1u) < queue->count) && (queue->task[queue->order[i - 1u]] == task)) {
            position = i - 1u;
        }
    }
    return position;
}

void model_queue_add(keel_queue_t *queue, const keel_task_config_t *task, uint64_t release_us)
{
    const keel_queue_t old = *queue;
    const bool realtime = task->priority == KEEL_PRIORITY_REALTIME;
    const uint32_t place = realtime ? old.realtime_count : old.count;
    const uint32_t slot = old.order[old.count];

    /* QUE-003: the first free slot becomes the last of its class, those behind it move down. */
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        if (i == place) {
            queue->order[i] = (uint8_t)slot;
        } else if ((i > place) && (i <= old.count)) {
            queue->order[i] = old.order[i - 1u];
        } else {
            queue->order[i] = old.order[i];
        }
    }
    queue->count = (uint8_t)(old.count + 1u);
    queue->realtime_count = (uint8_t)(old.realtime_count + (realtime ? 1u : 0u));
    /* QUE-003: what is declared, the first release, and nothing counted. */
    queue->task[slot] = task;
    queue->period_us[slot] = task->period_us;
    queue->budget_us[slot] = task->budget_us;
    queue->priority[slot] = (uint8_t)task->priority;
    queue->release_us[slot] = release_us;
    queue->skipped[slot] = 0u;
    queue->stats[slot] = (keel_stats_t){0};
}

void model_queue_remove(keel_queue_t *queue, uint32_t position)
{
    const keel_queue_t old = *queue;
    const uint32_t last = old.count - 1u;

    /* QUE-007: those behind it move up, its slot is the first free one. */
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        if ((i >= position) && (i < last)) {
            queue->order[i] = old.order[i + 1u];
        } else if (i == last) {
            queue->order[i] = old.order[position];
        } else {
            queue->order[i] = old.order[i];
        }
    }
    queue->count = (uint8_t)last;
    queue->realtime_count = (uint8_t)(old.realtime_count -
                                      ((position < old.realtime_count) ? 1u : 0u));
    queue->task[old.order[position]] = NULL;
}

void model_queue_advance(keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const uint64_t late_us = now_us - queue->release_us[slot];
    const uint64_t missed = late_us / queue->period_us[slot];
    const uint64_t skipped = queue->skipped[slot] + missed;

    /* QUE-009: on to the first point of the grid behind now, the periods between are counted. */
    queue->release_us[slot] += (missed + 1u) * queue->period_us[slot];
    queue->skipped[slot] = (skipped < UINT16_MAX) ? (uint16_t)skipped : UINT16_MAX;
}
