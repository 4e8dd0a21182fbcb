/**
 * @file admission_contracts.h
 * @brief What keel_admission_admit asks for and does, as expressions of C; no part of it divides.
 *
 * Its own harness proves that it keeps the contract; in the harness of a whole queue it stands in
 * for the function. That the utilisation grows by C / T is left to the former and to WP.
 */
#ifndef ADMISSION_CONTRACTS_H
#define ADMISSION_CONTRACTS_H

#include "keel/rtos/admission.h"

static bool demand_met(const keel_admission_t *totals)
{
    return (totals->realtime_demand_us == 0u) ||
           ((totals->realtime_demand_us + totals->guard_us + totals->guard_us) <=
            totals->shortest_realtime_us);
}

static bool gap_met(const keel_admission_t *totals)
{
    return (totals->longest_other_us == 0u) ||
           ((totals->longest_other_us + totals->guard_us) <= totals->shortest_gap_us);
}

/* What the totals become with one more task, but for the utilisation. */
static keel_admission_t totals_with(const keel_admission_t *totals,
                                    const keel_task_config_t *config)
{
    keel_admission_t with = *totals;

    with.tasks++;
    if (config->priority == KEEL_PRIORITY_REALTIME) {
        const uint64_t gap_us = (config->period_us > config->budget_us)
                                    ? ((uint64_t)config->period_us - config->budget_us)
                                    : 0u;

        with.realtime_demand_us += config->budget_us;
        if (config->period_us < with.shortest_realtime_us) {
            with.shortest_realtime_us = config->period_us;
        }
        if (gap_us < with.shortest_gap_us) {
            with.shortest_gap_us = gap_us;
        }
    } else if (config->budget_us > with.longest_other_us) {
        with.longest_other_us = config->budget_us;
    }
    return with;
}

static bool totals_same(const keel_admission_t *left, const keel_admission_t *right)
{
    return (left->guard_us == right->guard_us) &&
           (left->utilisation_limit == right->utilisation_limit) &&
           (left->realtime_demand_us == right->realtime_demand_us) &&
           (left->shortest_realtime_us == right->shortest_realtime_us) &&
           (left->shortest_gap_us == right->shortest_gap_us) &&
           (left->longest_other_us == right->longest_other_us) && (left->tasks == right->tasks);
}

static bool keel_admission_admit_may(const keel_admission_t *totals,
                                     const keel_task_config_t *config)
{
    return (totals->guard_us < KEEL_PERIOD_LIMIT_US) &&
           (totals->utilisation_limit <= KEEL_UTILISATION_FULL_PPM) &&
           (totals->utilisation <= totals->utilisation_limit) &&
           (totals->realtime_demand_us < KEEL_PERIOD_LIMIT_US) &&
           (totals->longest_other_us <= UINT32_MAX) && demand_met(totals) && gap_met(totals) &&
           (totals->tasks < KEEL_QUEUE_CAPACITY) && (config->period_us > 0u);
}

static bool keel_admission_admit_does(keel_status_t status, const keel_admission_t *before,
                                      const keel_admission_t *after,
                                      const keel_task_config_t *config)
{
    const keel_admission_t with = totals_with(before, config);

    if (!demand_met(&with)) {
        return (status == KEEL_ERR_REALTIME_DEMAND) && totals_same(after, before) &&
               (after->utilisation == before->utilisation);
    }
    if (!gap_met(&with)) {
        return (status == KEEL_ERR_BUDGET_GAP) && totals_same(after, before) &&
               (after->utilisation == before->utilisation);
    }
    if (status == KEEL_OK) {
        return totals_same(after, &with) && (before->utilisation <= after->utilisation) &&
               (after->utilisation <= after->utilisation_limit);
    }
    return (status == KEEL_ERR_UTILISATION) && totals_same(after, before) &&
           (after->utilisation == before->utilisation);
}

#endif
