/* SPDX-License-Identifier: Apache-2.0 */
#include "task.h"

/* TSK-002: the first that applies. */
keel_status_t model_task_check(const keel_task_config_t *config)
{
    if ((config == NULL) || (config->run == NULL)) {
        return KEEL_ERR_NULL;
    }
    if ((config->period_us < 1u) || (config->period_us > 0x7FFFFFFFu)) {
        return KEEL_ERR_PERIOD;
    }
    if (config->phase_us >= config->period_us) {
        return KEEL_ERR_PHASE;
    }
    if (config->budget_us < 1u) {
        return KEEL_ERR_BUDGET_ZERO;
    }
    if ((config->priority != KEEL_PRIORITY_LOW) && (config->priority != KEEL_PRIORITY_MEDIUM) &&
        (config->priority != KEEL_PRIORITY_MEDIUM_HIGH) &&
        (config->priority != KEEL_PRIORITY_HIGH) && (config->priority != KEEL_PRIORITY_REALTIME)) {
        return KEEL_ERR_PRIORITY;
    }
    return KEEL_OK;
}
