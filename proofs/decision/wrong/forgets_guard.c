// harness: keel_decision_other_harness
// expect: DEC_003_eligible
//
// The guard is not part of what must fit the slack.
#include "keel/rtos/decision.h"

#include <stdbool.h>

uint32_t keel_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                uint64_t now_us)
{
    uint32_t i = from;

    while ((i < to) && (queue->task[i]->release_us > now_us)) {
        i++;
    }
    return i;
}

static uint64_t time_to_release_us(const keel_task_t *task, uint64_t now_us)
{
    return (task->release_us > now_us) ? (task->release_us - now_us) : 0u;
}

uint64_t keel_decision_slack_us(const keel_queue_t *queue, uint64_t now_us)
{
    uint64_t slack_us = KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < queue->realtime_count; i++) {
        const uint64_t time_us = time_to_release_us(queue->task[i], now_us);

        if (time_us < slack_us) {
            slack_us = time_us;
        }
    }
    return slack_us;
}

static uint32_t priority_of(const keel_task_t *task, uint64_t now_us)
{
    const uint32_t period_us = task->config->period_us;

    return keel_priority_dynamic(task->config->priority, (now_us - task->release_us) + period_us,
                                 period_us);
}

static bool fits(const keel_task_t *task, uint64_t slack_us, uint32_t guard_us)
{
    const uint32_t budget_us = task->config->budget_us;
    const uint32_t longest_us = task->stats.longest_us;
    const uint32_t worst_us = (longest_us > budget_us) ? longest_us : budget_us;

    return (worst_us + (0u * (uint64_t)guard_us)) <= slack_us;
}

/* The dynamic priority with which a task competes now: 0, as in eq. 3, when it is not eligible. */
static uint32_t competing_priority(const keel_task_t *task, uint64_t now_us, uint64_t slack_us,
                                   uint32_t guard_us)
{
    uint32_t priority;

    if (task->release_us > now_us) {
        return 0u;
    }
    priority = priority_of(task, now_us);
    if ((priority < KEEL_PRIORITY_REALTIME) && !fits(task, slack_us, guard_us)) {
        return 0u;
    }
    return priority;
}

uint32_t keel_decision_other(const keel_queue_t *queue, uint64_t now_us, uint64_t slack_us,
                             uint32_t guard_us)
{
    uint32_t best = queue->count;
    uint32_t best_priority = 0u;

    for (uint32_t i = queue->realtime_count; i < queue->count; i++) {
        const uint32_t priority = competing_priority(queue->task[i], now_us, slack_us, guard_us);

        if (priority > best_priority) {
            best = i;
            best_priority = priority;
        }
    }
    return best;
}

static uint64_t next_event_us(const keel_task_t *task, uint64_t now_us)
{
    const keel_task_config_t *config = task->config;

    if ((task->release_us > now_us) || (config->priority == KEEL_PRIORITY_REALTIME)) {
        return task->release_us;
    }
    return task->release_us + (keel_priority_promotion_age_us(config->priority, config->period_us) -
                               config->period_us);
}

uint64_t keel_decision_wake_us(const keel_queue_t *queue, uint64_t now_us)
{
    uint64_t wake_us = KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < queue->count; i++) {
        const uint64_t event_us = next_event_us(queue->task[i], now_us);

        if (event_us < wake_us) {
            wake_us = event_us;
        }
    }
    return wake_us;
}
