/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file decision_contracts.h
 * @brief What the functions of decision.h ask for and do, as far as a pass needs to know.
 *
 * Their own harnesses prove that they keep these; in the harness of a pass they stand in for the
 * functions. That they do what the model does is more than that, and is asserted beside it.
 */
#ifndef DECISION_CONTRACTS_H
#define DECISION_CONTRACTS_H

#include "keel/internal/rtos/decision.h"
#include "keel_proof.h"

static bool is_other(const keel_queue_t *queue, uint32_t i)
{
    return (queue->realtime_count <= i) && (i < queue->count);
}

static uint64_t release_at(const keel_queue_t *queue, uint32_t i)
{
    return queue->release_us[queue->order[i]];
}

/* Whether a time is the earliest release among positions first to last - 1, or that of none
 * (is_earliest). */
static bool is_earliest(const keel_queue_t *queue, uint32_t first, uint32_t last, uint64_t time_us)
{
    bool bound = true;
    bool met = time_us == KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        if ((first <= i) && (i < last)) {
            bound = bound && (time_us <= release_at(queue, i));
            met = met || (time_us == release_at(queue, i));
        }
    }
    return bound && met;
}

static bool keel_decision_realtime_may(const keel_queue_t *queue, uint32_t from, uint32_t to)
{
    return (from <= to) && (to <= queue->realtime_count);
}

static bool keel_decision_realtime_does(uint32_t found, const keel_queue_t *queue, uint32_t from,
                                        uint32_t to, uint64_t now_us)
{
    bool first = (from <= found) && (found <= to);

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const bool due = release_at(queue, i) <= now_us;

        first = first && ((i != found) || (found == to) || due);
        first = first && ((i < from) || (found <= i) || !due);
    }
    return first;
}

static bool keel_decision_earliest_us_may(const keel_queue_t *queue)
{
    return queue->realtime_count <= CAPACITY;
}

static bool keel_decision_earliest_us_does(uint64_t earliest_us, const keel_queue_t *queue)
{
    return is_earliest(queue, 0u, queue->realtime_count, earliest_us);
}

static bool keel_decision_other_may(const keel_queue_t *queue, uint64_t now_us)
{
    return (queue->realtime_count <= queue->count) && (queue->count <= CAPACITY) &&
           (now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

static bool keel_decision_other_does(const keel_choice_t *choice, const keel_queue_t *queue,
                                     uint64_t now_us)
{
    bool released = false;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        released = released || ((i == choice->position) && is_other(queue, i) &&
                                (release_at(queue, i) <= now_us));
    }
    return (choice->priority <= KEEL_PRIORITY_REALTIME) &&
           is_earliest(queue, queue->realtime_count, queue->count, choice->earliest_us) &&
           ((choice->priority > 0u) ? released : (choice->position == 0u));
}

static bool keel_decision_event_us_may(const keel_queue_t *queue, uint64_t now_us)
{
    return keel_decision_other_may(queue, now_us);
}

/* Nothing that a pass relies on in the code. */
static bool keel_decision_event_us_does(uint64_t event_us, uint64_t modelled_us)
{
    return event_us == modelled_us;
}

#endif
