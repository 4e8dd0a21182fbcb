/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file many_tasks.h
 * @brief Queues of chosen content and any number of tasks.
 */
#ifndef MANY_TASKS_H
#define MANY_TASKS_H

#include "queue_contracts.h"

/* A queue of so many tasks, the first of which are real-time; a slot is not at its own place. */
static keel_queue_t queue_of(uint32_t count, uint32_t realtime_count)
{
    keel_queue_t queue = {.count = (uint8_t)count, .realtime_count = (uint8_t)realtime_count};

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint32_t x = slot_at(i);

        queue.order[i] = (uint8_t)x;
        queue.task[x] = (i < count) ? &proof_config[x] : NULL;
        queue.priority[x] = (uint8_t)((i < realtime_count) ? KEEL_PRIORITY_REALTIME
                                                           : KEEL_PRIORITY_HIGH);
        queue.period_us[x] = 1000u + x;
        queue.budget_us[x] = 1u + (x % 8u);
        queue.release_us[x] = 5000u + x;
        queue.skipped[x] = (uint16_t)(20u + x);
        queue.stats[x].runs = 30u + x;
    }
    return queue;
}

#endif
