/**
 * @file decision_contracts.h
 * @brief The logic of decision.h as expressions of C, for numbers of their full width.
 *
 * What the functions ask for and do that look at all tasks which are not real-time. Their own
 * harnesses prove that they keep these, seen at an arbitrary position; in the harness of a pass
 * these stand in for them.
 */
#ifndef DECISION_CONTRACTS_H
#define DECISION_CONTRACTS_H

#include "keel/rtos/decision.h"
#include "keel_proof.h"

static bool is_other(const keel_queue_t *queue, uint32_t i)
{
    return (queue->realtime_count <= i) && (i < queue->count);
}

/* Of the task in each slot, if it is released: its dynamic priority at the time of the decision
 * (task_priority), and when it is promoted (promotion). Any numbers: that they are eq. 3's is
 * proved of the unit priority, and nothing else here depends on it. A number that both sides read
 * costs the solver nothing, where it would not come to an end with the products of eq. 3. */
static uint32_t proof_priority[CAPACITY];
static uint64_t proof_promotion_us[CAPACITY];

static void any_priorities(void)
{
    for (uint32_t x = 0u; x < CAPACITY; x++) {
        proof_priority[x] = any_below(KEEL_PRIORITY_REALTIME) + 1u;
        proof_promotion_us[x] = nondet_u64();
    }
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
    priority = proof_priority[x];
    return ((priority == KEEL_PRIORITY_REALTIME) || (task_worst(queue, x) <= room_us)) ? priority
                                                                                       : 0u;
}

/* When waiting alone makes the task in slot x run (next_event). */
static uint64_t event_of(const keel_queue_t *queue, uint32_t x, uint64_t now_us)
{
    return (queue->release_us[x] > now_us) ? queue->release_us[x] : proof_promotion_us[x];
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
    return !is_other(queue, i) || (event_us <= event_of(queue, queue->order[i], now_us));
}

#endif
