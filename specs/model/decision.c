/* SPDX-License-Identifier: Apache-2.0 */
#include "decision.h"

#include "priority.h"

#include <stdbool.h>

uint32_t model_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                 uint64_t now_us)
{
    uint32_t first = to; /* DEC-001: when none is due */

    for (uint32_t i = KEEL_QUEUE_CAPACITY; i > 0u; i--) {
        if ((from < i) && (i <= to) && (queue->release_us[queue->order[i - 1u]] <= now_us)) {
            first = i - 1u;
        }
    }
    return first;
}

/* The earliest release among positions first to last - 1. */
static uint64_t earliest_us_of(const keel_queue_t *queue, uint32_t first, uint32_t last)
{
    uint64_t earliest_us = KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint64_t release_us = queue->release_us[queue->order[i]];

        if ((first <= i) && (i < last) && (release_us < earliest_us)) {
            earliest_us = release_us;
        }
    }
    return earliest_us;
}

uint64_t model_decision_earliest_us(const keel_queue_t *queue)
{
    return earliest_us_of(queue, 0u, queue->realtime_count); /* DEC-002 */
}

uint32_t model_decision_room_us(uint64_t earliest_us, uint64_t now_us, uint32_t guard_us)
{
    /* DEC-005: what the slack leaves beside the guard. */
    const uint64_t slack_us = (earliest_us > now_us) ? (earliest_us - now_us) : 0u;
    const uint64_t room_us = (slack_us > guard_us) ? (slack_us - guard_us) : 0u;

    return (room_us < UINT32_MAX) ? (uint32_t)room_us : UINT32_MAX;
}

/* Eq. 3 for the task in a slot, which is released: its age counts from the release before. */
static uint32_t priority_of(const keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const uint64_t age_us = (now_us - queue->release_us[slot]) + queue->period_us[slot];

    return model_priority_dynamic(queue->priority[slot], age_us, queue->period_us[slot]);
}

/* DEC-003: W + w <= S, w being the budget or the longest overrun that is remembered, whichever is
 * longer. */
static bool fits(const keel_queue_t *queue, uint32_t slot, uint32_t room_us)
{
    const uint32_t remembered_us = queue->stats[slot].remembered_us;
    const uint32_t budget_us = queue->budget_us[slot];

    return ((remembered_us > budget_us) ? remembered_us : budget_us) <= room_us;
}

keel_choice_t model_decision_other(const keel_queue_t *queue, uint64_t now_us, uint32_t room_us,
                                   bool without_promotion)
{
    keel_choice_t choice = {earliest_us_of(queue, queue->realtime_count, queue->count), 0u, 0u};

    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint32_t slot = queue->order[i];
        uint32_t priority = 0u; /* not eligible */

        if ((queue->realtime_count <= i) && (i < queue->count) &&
            (queue->release_us[slot] <= now_us)) {
            priority = priority_of(queue, slot, now_us);
            if ((without_promotion || (priority < KEEL_PRIORITY_REALTIME)) &&
                !fits(queue, slot, room_us)) {
                priority = 0u; /* DEC-003: only a promoted task runs whether it fits or not */
            }
        }
        if (priority > choice.priority) { /* DEC-003: the first of the highest */
            choice.position = i;
            choice.priority = priority;
        }
    }
    return choice;
}

uint64_t model_decision_event_us(const keel_queue_t *queue, uint64_t now_us, bool without_promotion)
{
    uint64_t event_us = KEEL_TIME_NEVER_US;

    /* DEC-004: the first release that lies ahead, or promotion of a task that is released; where
     * none is promoted, none of these is an event. */
    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint32_t slot = queue->order[i];
        uint64_t at_us = KEEL_TIME_NEVER_US;

        if ((queue->realtime_count <= i) && (i < queue->count) &&
            (!without_promotion || (queue->release_us[slot] > now_us))) {
            at_us = queue->release_us[slot];
            if (at_us <= now_us) {
                at_us += model_priority_promotion_age_us(queue->priority[slot],
                                                         queue->period_us[slot]) -
                         queue->period_us[slot];
            }
        }
        event_us = (at_us < event_us) ? at_us : event_us;
    }
    return event_us;
}
