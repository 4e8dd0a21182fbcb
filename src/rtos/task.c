/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/task.h"

#include <stdbool.h>

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
