/**
 * @file decision_contracts.h
 * @brief The logic of decision.h as expressions of C, for numbers of their full width.
 *
 * Eq. 3 and the age of promotion without a division; and of the functions that divide, or look at
 * all tasks, what each asks for and does. Its own harness proves that a function keeps its
 * contract, in others that contract stands in for it.
 */
#ifndef DECISION_CONTRACTS_H
#define DECISION_CONTRACTS_H

#include "keel/rtos/decision.h"
#include "keel_proof.h"

/* (max - 1) * T / sp, rounded up: quotients by constants, which to the solver are no divisions. */
static uint64_t promotion_age(uint32_t sp, uint32_t period_us)
{
    const uint64_t limit = 15u * (uint64_t)period_us;
    uint64_t age_us = 0u;

    switch (sp) {
    case 1u:
        age_us = limit;
        break;
    case 2u:
        age_us = (limit + 1u) / 2u;
        break;
    case 3u:
        age_us = (limit + 2u) / 3u;
        break;
    case 4u:
        age_us = (limit + 3u) / 4u;
        break;
    default:
        __CPROVER_assert(false, "promotion_age: asked of another task only");
        break;
    }
    return age_us;
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

/* When waiting alone makes a task run that is not real-time (next_event, promotion). */
static uint64_t promotion(const keel_queue_t *queue, uint32_t x)
{
    return queue->release_us[x] +
           (promotion_age(queue->priority[x], queue->period_us[x]) - queue->period_us[x]);
}

static uint64_t next_event(const keel_queue_t *queue, uint32_t x, uint64_t now_us)
{
    return (queue->release_us[x] > now_us) ? queue->release_us[x] : promotion(queue, x);
}

/* Whether a time is one of the releases among positions first to last - 1, or that of none
 * (is_earliest, its second half). */
static bool is_some_release(const keel_queue_t *queue, uint32_t first, uint32_t last,
                            uint64_t time_us)
{
    bool met = time_us == KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < CAPACITY; i++) {
        met = met || ((first <= i) && (i < last) &&
                      (time_us == queue->release_us[queue->order[i]]));
    }
    return met;
}

/* keel_priority_dynamic, as its header says. */
static bool keel_priority_dynamic_may(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    (void)age_us;
    return (1u <= sp) && (sp <= KEEL_PRIORITY_REALTIME) && (0u < period_us) &&
           (period_us < KEEL_PERIOD_LIMIT_US);
}

static bool keel_priority_dynamic_does(uint32_t priority, uint32_t sp, uint64_t age_us,
                                       uint32_t period_us)
{
    return priority == dynamic_priority(sp, age_us, period_us);
}

/* keel_priority_promotion_age_us, of a task that is not real-time. */
static bool keel_priority_promotion_age_us_may(uint32_t sp, uint32_t period_us)
{
    return (1u <= sp) && (sp <= KEEL_PRIORITY_REALTIME) && (0u < period_us) &&
           (period_us < KEEL_PERIOD_LIMIT_US);
}

static bool keel_priority_promotion_age_us_does(uint64_t age_us, uint32_t sp, uint32_t period_us)
{
    return (sp > KEEL_PRIORITY_HIGH) || (age_us == promotion_age(sp, period_us));
}

static bool is_queue_position(const keel_queue_t *queue, uint32_t i)
{
    return (queue->realtime_count <= i) && (i < queue->count);
}

/* The choice among the tasks that are not real-time, as seen at a rival's position. */
static bool keel_decision_other_may(const keel_queue_t *queue, uint64_t now_us, uint32_t room_us)
{
    (void)room_us;
    return (queue->count <= CAPACITY) && (queue->realtime_count <= queue->count) &&
           (now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

/* With what dynamic priority the task at a position competes: 0 when it is not eligible. */
static uint32_t competing(const keel_queue_t *queue, uint32_t i, uint64_t now_us, uint32_t room_us)
{
    const uint32_t x = queue->order[i];
    uint32_t priority;

    if (!is_queue_position(queue, i) || (queue->release_us[x] > now_us)) {
        return 0u;
    }
    priority = task_priority(queue, x, now_us);
    return ((priority == KEEL_PRIORITY_REALTIME) || (task_worst(queue, x) <= room_us)) ? priority
                                                                                       : 0u;
}

static bool keel_decision_other_does(const keel_choice_t *choice, const keel_queue_t *queue,
                                     uint64_t now_us, uint32_t room_us, uint32_t rival)
{
    const uint32_t priority = competing(queue, rival, now_us, room_us);

    return (choice->priority <= KEEL_PRIORITY_REALTIME) && (priority <= choice->priority) &&
           ((choice->priority == 0u) || (rival >= choice->position) ||
            (priority < choice->priority)) &&
           ((choice->priority == 0u) ||
            (is_queue_position(queue, choice->position) &&
             (choice->priority == competing(queue, choice->position, now_us, room_us)))) &&
           (!is_queue_position(queue, rival) ||
            (choice->earliest_us <= queue->release_us[queue->order[rival]]));
}

/* The time of the next event, as seen at a position. */
static bool keel_decision_event_us_may(const keel_queue_t *queue, uint64_t now_us)
{
    return keel_decision_other_may(queue, now_us, 0u);
}

static bool keel_decision_event_us_does(uint64_t event_us, const keel_queue_t *queue,
                                        uint64_t now_us, uint32_t i)
{
    return !is_queue_position(queue, i) || (event_us <= next_event(queue, queue->order[i], now_us));
}

#endif
