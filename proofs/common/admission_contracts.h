/**
 * @file admission_contracts.h
 * @brief What keel_admission_admit asks for and does, as expressions of C; no part of it divides.
 *
 * Its own harness proves that it keeps the contract, for the share C / T that it adds; in the
 * harness of a whole queue it stands in for the function, with any share.
 */
#ifndef ADMISSION_CONTRACTS_H
#define ADMISSION_CONTRACTS_H

#include "keel/rtos/admission.h"
#include "keel_proof.h"

/* No share has more bits: a budget in us, scaled to ppm. */
#define SHARE_BITS 52u

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

/* The first rule that totals break, or KEEL_OK. */
static keel_status_t verdict_on(const keel_admission_t *totals)
{
    if (!demand_met(totals)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if (!gap_met(totals)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    return (totals->utilisation <= totals->utilisation_limit) ? KEEL_OK : KEEL_ERR_UTILISATION;
}

/* Totals that admission leaves behind (admission_valid). */
static bool totals_valid(const keel_admission_t *totals)
{
    return (totals->guard_us < KEEL_PERIOD_LIMIT_US) &&
           (totals->utilisation_limit <= KEEL_UTILISATION_FULL_PPM) &&
           (totals->realtime_demand_us < KEEL_PERIOD_LIMIT_US) &&
           (totals->longest_other_us <= UINT32_MAX) && (totals->tasks <= KEEL_QUEUE_CAPACITY) &&
           (verdict_on(totals) == KEEL_OK);
}

/* What totals become with one more task. */
static keel_admission_t totals_with(const keel_admission_t *totals, uint32_t priority,
                                    uint32_t period_us, uint32_t budget_us, uint64_t share)
{
    const uint64_t gap_us = (period_us > budget_us) ? ((uint64_t)period_us - budget_us) : 0u;
    keel_admission_t with = *totals;

    with.tasks++;
    with.utilisation += share;
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

static bool totals_same(const keel_admission_t *left, const keel_admission_t *right)
{
    return (left->guard_us == right->guard_us) &&
           (left->utilisation_limit == right->utilisation_limit) &&
           (left->utilisation == right->utilisation) &&
           (left->realtime_demand_us == right->realtime_demand_us) &&
           (left->shortest_realtime_us == right->shortest_realtime_us) &&
           (left->shortest_gap_us == right->shortest_gap_us) &&
           (left->longest_other_us == right->longest_other_us) && (left->tasks == right->tasks);
}

static bool keel_admission_admit_may(const keel_admission_t *totals, uint32_t period_us,
                                     uint32_t budget_us)
{
    return totals_valid(totals) && (totals->tasks < KEEL_QUEUE_CAPACITY) && (0u < period_us) &&
           (period_us < KEEL_PERIOD_LIMIT_US) && (0u < budget_us);
}

/* Whether it did; with are the totals with the task. */
static bool keel_admission_admit_does(keel_status_t status, const keel_admission_t *before,
                                      const keel_admission_t *after, const keel_admission_t *with)
{
    return (status == verdict_on(with)) && totals_same(after, (status == KEEL_OK) ? with : before);
}

#endif
