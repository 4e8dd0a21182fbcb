// harness: keel_admission_admit_harness
// expect: ADM_003_demand
//
// The demand leaves room for one guard only.
#include "keel/rtos/admission.h"

void keel_admission_init(keel_admission_t *admission, uint32_t guard_us, uint32_t utilisation_limit)
{
    admission->guard_us = guard_us;
    admission->utilisation_limit = utilisation_limit;
    admission->utilisation = 0u;
    admission->realtime_demand_us = 0u;
    admission->shortest_realtime_us = UINT64_MAX;
    admission->shortest_gap_us = UINT64_MAX;
    admission->longest_other_us = 0u;
    admission->tasks = 0u;
}

static uint64_t minimum(uint64_t a, uint64_t b)
{
    return (a < b) ? a : b;
}

static uint64_t utilisation_of(const keel_task_config_t *config)
{
    const uint64_t scaled = (uint64_t)config->budget_us * KEEL_UTILISATION_FULL_PPM;

    return (scaled + (config->period_us - 1u)) / config->period_us;
}

static uint64_t gap_of(const keel_task_config_t *config)
{
    return (config->budget_us < config->period_us) ? (config->period_us - config->budget_us) : 0u;
}

keel_status_t keel_admission_admit(keel_admission_t *admission, const keel_task_config_t *config)
{
    const uint64_t utilisation = admission->utilisation + utilisation_of(config);
    uint64_t demand_us = admission->realtime_demand_us;
    uint64_t period_us = admission->shortest_realtime_us;
    uint64_t gap_us = admission->shortest_gap_us;
    uint64_t other_us = admission->longest_other_us;

    if (config->priority == KEEL_PRIORITY_REALTIME) {
        demand_us += config->budget_us;
        period_us = minimum(period_us, config->period_us);
        gap_us = minimum(gap_us, gap_of(config));
    } else if (config->budget_us > other_us) {
        other_us = config->budget_us;
    } else {
        /* A longer budget was admitted before: no limit changes. */
    }
    if ((demand_us > 0u) && ((demand_us + admission->guard_us) > period_us)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if ((other_us > 0u) && ((other_us + admission->guard_us) > gap_us)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    if (utilisation > admission->utilisation_limit) {
        return KEEL_ERR_UTILISATION;
    }
    admission->utilisation = utilisation;
    admission->realtime_demand_us = demand_us;
    admission->shortest_realtime_us = period_us;
    admission->shortest_gap_us = gap_us;
    admission->longest_other_us = other_us;
    admission->tasks++;
    return KEEL_OK;
}

keel_status_t keel_admission_queue(keel_admission_t *admission, const keel_queue_t *queue)
{
    for (uint32_t i = 0u; i < queue->count; i++) {
        const keel_status_t status = keel_admission_admit(admission, queue->task[i]->config);

        if (status != KEEL_OK) {
            return status;
        }
    }
    return KEEL_OK;
}
