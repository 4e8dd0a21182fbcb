#include "keel/rtos/task.h"

/*@ assigns \nothing;
  @ ensures \result <==> priority_valid(priority);
  @*/
static bool priority_is_valid(uint32_t priority)
{
    return ((priority >= KEEL_PRIORITY_LOW) && (priority <= KEEL_PRIORITY_HIGH)) ||
           (priority == KEEL_PRIORITY_REALTIME);
}

keel_status_t keel_task_check(const keel_task_config_t *config)
{
    if ((config == NULL) || (config->run == NULL)) {
        return KEEL_ERR_NULL;
    }
    if ((config->period_us == 0u) || (config->period_us >= KEEL_PERIOD_LIMIT_US)) {
        return KEEL_ERR_PERIOD;
    }
    if (config->phase_us >= config->period_us) {
        return KEEL_ERR_PHASE;
    }
    if (config->budget_us == 0u) {
        return KEEL_ERR_BUDGET_ZERO;
    }
    if (!priority_is_valid(config->priority)) {
        return KEEL_ERR_PRIORITY;
    }
    return KEEL_OK;
}

void keel_task_arm(keel_task_t *task, uint64_t start_us)
{
    task->skipped = 0u;
    task->release_us = start_us + task->config->phase_us;
    task->stats.total_us = 0u;
    task->stats.runs = 0u;
    task->stats.last_us = 0u;
    task->stats.longest_us = 0u;
    task->stats.overruns = 0u;
    task->stats.promotions = 0u;
}

/*@ assigns \nothing;
  @ ensures \result == \min(UINT16_MAX, value + more);
  @*/
static uint16_t add_saturating(uint16_t value, uint64_t more)
{
    const uint16_t room = (uint16_t)(UINT16_MAX - value);

    return (more > room) ? UINT16_MAX : (uint16_t)(value + more);
}

void keel_task_advance(keel_task_t *task, uint64_t now_us)
{
    const uint32_t period_us = task->config->period_us;
    const uint64_t late_us = now_us - task->release_us;
    /* On the target a division of 64 bits is a call, which a task that is on time does without. */
    const uint64_t missed = (late_us < period_us) ? 0u : (late_us / period_us);

    //@ assert floor: missed * period_us <= late_us < (missed + 1) * period_us;
    task->release_us += (missed + 1u) * period_us;
    task->skipped = add_saturating(task->skipped, missed);
}
