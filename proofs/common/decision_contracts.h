/**
 * @file decision_contracts.h
 * @brief The logic of decision.h as expressions of C, for numbers of their full width.
 *
 * Eq. 3 and the time of a promotion without a division; and what the functions ask for and do that
 * look at all tasks which are not real-time. Their own harnesses prove that they keep these, seen
 * at an arbitrary position; in the harness of a pass these stand in for them.
 */
#ifndef DECISION_CONTRACTS_H
#define DECISION_CONTRACTS_H

#include "keel/rtos/decision.h"
#include "keel_proof.h"

static bool is_other(const keel_queue_t *queue, uint32_t i)
{
    return (queue->realtime_count <= i) && (i < queue->count);
}

/* The dynamic priority of a released task (task_priority). */
static uint32_t task_priority(const keel_queue_t *queue, uint32_t x, uint64_t now_us)
{
    return dynamic_priority(queue->priority[x],
                            (now_us - queue->release_us[x]) + queue->period_us[x],
                            queue->period_us[x]);
}

/* w (task_worst). */
static uint32_t task_worst(const keel_queue_t *queue, uint32_t x)
{
    const uint32_t longest_us = queue->stats[x].longest_us;

    return (longest_us > queue->budget_us[x]) ? longest_us : queue->budget_us[x];
}

/* With what dynamic priority the task at a position competes: 0 when it is not eligible. */
static uint32_t competing(const keel_queue_t *queue, uint32_t i, uint64_t now_us, uint32_t room_us)
{
    const uint32_t x = queue->order[i];
    uint32_t priority;

    if (!is_other(queue, i) || (queue->release_us[x] > now_us)) {
        return 0u;
    }
    priority = task_priority(queue, x, now_us);
    return ((priority == KEEL_PRIORITY_REALTIME) || (task_worst(queue, x) <= room_us)) ? priority
                                                                                       : 0u;
}

/* Whether at a time a task in slot x has not been promoted, or is promoted just then: the time is
 * not behind its promotion, 15 T / sp - T after its release, rounded up. */
static bool is_up_to_promotion(const keel_queue_t *queue, uint32_t x, uint64_t time_us)
{
    const uint64_t period_us = queue->period_us[x];
    uint64_t wait_us;

    if (time_us <= queue->release_us[x]) {
        return true;
    }
    wait_us = time_us - queue->release_us[x];
    return (wait_us < (16u * period_us)) &&
           ((queue->priority[x] * (wait_us + period_us - 1u)) < (15u * period_us));
}

/* Whether a time is not behind the next event of the task in slot x (next_event), or is it. */
static bool is_up_to_event(const keel_queue_t *queue, uint32_t x, uint64_t now_us, uint64_t time_us)
{
    return (queue->release_us[x] > now_us) ? (time_us <= queue->release_us[x])
                                           : is_up_to_promotion(queue, x, time_us);
}

static bool is_event(const keel_queue_t *queue, uint32_t x, uint64_t now_us, uint64_t time_us)
{
    return (time_us < UINT64_MAX) && is_up_to_event(queue, x, now_us, time_us) &&
           !is_up_to_event(queue, x, now_us, time_us + 1u);
}

/* Whether a time is one of the releases among positions first to last - 1, or that of none (the
 * second half of is_earliest). */
static bool is_some_release(const keel_queue_t *queue, uint32_t first, uint32_t last,
                            uint64_t time_us)
{
    bool met = time_us == KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        met = met ||
              ((first <= i) && (i < last) && (time_us == queue->release_us[queue->order[i]]));
    }
    return met;
}

static bool keel_decision_other_may(const keel_queue_t *queue, uint64_t now_us)
{
    return (queue->realtime_count <= queue->count) && (queue->count <= CAPACITY) &&
           (now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

static bool keel_decision_other_does(const keel_choice_t *choice, const keel_queue_t *queue,
                                     uint64_t now_us, uint32_t room_us, uint32_t rival)
{
    const uint32_t priority = competing(queue, rival, now_us, room_us);
    const bool some = choice->priority > 0u;

    return (choice->priority <= KEEL_PRIORITY_REALTIME) && (priority <= choice->priority) &&
           (!some || (rival >= choice->position) || (priority < choice->priority)) &&
           (!some || (is_other(queue, choice->position) &&
                      (choice->priority == competing(queue, choice->position, now_us, room_us)))) &&
           (!is_other(queue, rival) ||
            (choice->earliest_us <= queue->release_us[queue->order[rival]]));
}

static bool keel_decision_event_us_may(const keel_queue_t *queue, uint64_t now_us)
{
    return keel_decision_other_may(queue, now_us);
}

static bool keel_decision_event_us_does(uint64_t event_us, const keel_queue_t *queue,
                                        uint64_t now_us, uint32_t i)
{
    return !is_other(queue, i) || is_up_to_event(queue, queue->order[i], now_us, event_us);
}

#endif
