/* SPDX-License-Identifier: Apache-2.0 */
#include "admission.h"

void model_admission_init(keel_admission_t *admission, uint32_t guard_us,
                          uint32_t utilisation_limit_ppm)
{
    /* ADM-001: the totals of no task. */
    *admission = (keel_admission_t){.guard_us = guard_us,
                                    .utilisation_limit_ppm = utilisation_limit_ppm,
                                    .shortest_realtime_us = UINT64_MAX,
                                    .shortest_gap_us = UINT64_MAX};
}

/* ADM-002: the totals with one more task. */
static keel_admission_t with_task(const keel_admission_t *totals, uint32_t priority,
                                  uint32_t period_us, uint32_t budget_us)
{
    const uint64_t gap_us = (budget_us < period_us) ? (period_us - budget_us) : 0u;
    const uint64_t scaled = (uint64_t)budget_us * KEEL_UTILISATION_FULL_PPM;
    keel_admission_t with = *totals;

    with.tasks++;
    with.utilisation_ppm += (scaled + ((uint64_t)period_us - 1u)) /
                            period_us; /* C / T, rounded up */
    if (priority == KEEL_PRIORITY_REALTIME) {
        with.realtime_demand_us += budget_us;
        if (period_us < with.shortest_realtime_us) {
            with.shortest_realtime_us = period_us;
        }
        if (gap_us < with.shortest_gap_us) {
            with.shortest_gap_us = gap_us;
        }
    } else if (budget_us > with.longest_other_us) {
        with.longest_other_us = budget_us;
    }
    return with;
}

/* ADM-003: the first rule that the totals of a set break, or KEEL_OK. */
static keel_status_t verdict_on(const keel_admission_t *totals)
{
    const uint64_t demand_us = totals->realtime_demand_us;
    const uint64_t longest_us = totals->longest_other_us;

    if ((demand_us > 0u) &&
        ((demand_us + (2u * totals->guard_us)) > totals->shortest_realtime_us)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if ((longest_us > 0u) && ((longest_us + totals->guard_us) > totals->shortest_gap_us)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    return (totals->utilisation_ppm > totals->utilisation_limit_ppm) ? KEEL_ERR_UTILISATION
                                                                     : KEEL_OK;
}

keel_status_t model_admission_admit(keel_admission_t *admission, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us)
{
    const keel_admission_t with = with_task(admission, priority, period_us, budget_us);
    const keel_status_t status = verdict_on(&with);

    if (status == KEEL_OK) {
        *admission = with; /* ADM-002; a refusal keeps the totals */
    }
    return status;
}
