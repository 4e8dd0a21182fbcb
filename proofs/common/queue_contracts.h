/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file queue_contracts.h
 * @brief What the functions of queue.h that write ask for; what they do is what the model does.
 *
 * Each function's own harness proves it. In the harness of a caller a stand-in leaves what the
 * model's call has left, and asserts that it was called with the same.
 */
#ifndef QUEUE_CONTRACTS_H
#define QUEUE_CONTRACTS_H

#include "../../specs/model/queue.h"
#include "keel_proof.h"

static bool keel_queue_add_may(const keel_queue_t *queue, const keel_task_config_t *task)
{
    return (queue->count < CAPACITY) && config_is_valid_here(task);
}

static bool keel_queue_add_does(const keel_queue_t *queue, const keel_queue_t *modelled, uint32_t x)
{
    return queue_same(queue, modelled, x);
}

static bool keel_queue_remove_may(const keel_queue_t *queue, uint32_t position)
{
    return position < queue->count;
}

static bool keel_queue_remove_does(const keel_queue_t *queue, const keel_queue_t *modelled,
                                   uint32_t x)
{
    return queue_same(queue, modelled, x);
}

static bool keel_queue_advance_may(const keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    return (slot < CAPACITY) && (0u < queue->period_us[slot]) &&
           (queue->period_us[slot] < KEEL_PERIOD_LIMIT_US) && (queue->release_us[slot] <= now_us) &&
           (now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

static bool keel_queue_advance_does(const keel_queue_t *queue, const keel_queue_t *modelled,
                                    uint32_t x)
{
    return queue_same(queue, modelled, x);
}

#endif
