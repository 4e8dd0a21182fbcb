/**
 * @file admission_proof.h
 * @brief The rules of admission for a whole queue, one task after the other, as expressions of C.
 */
#ifndef ADMISSION_PROOF_H
#define ADMISSION_PROOF_H

#include "keel_scheduler_proof.h"

/* What the first n tasks of a queue come to. */
typedef struct totals {
    uint64_t demand_us;
    uint64_t shortest_us;
    uint64_t gap_us;
    uint64_t longest_us;
    uint64_t utilisation;
} totals_t;

static const totals_t no_totals = {0u, UINT64_MAX, UINT64_MAX, 0u, 0u};

/* With one more task. */
static totals_t totals_and(totals_t totals, uint32_t priority, uint32_t period_us,
                           uint32_t budget_us)
{
    const uint64_t gap_us = (period_us > budget_us) ? (period_us - budget_us) : 0u;

    if (priority == KEEL_PRIORITY_REALTIME) {
        totals.demand_us += budget_us;
        totals.shortest_us = (period_us < totals.shortest_us) ? period_us : totals.shortest_us;
        totals.gap_us = (gap_us < totals.gap_us) ? gap_us : totals.gap_us;
    } else {
        totals.longest_us = (budget_us > totals.longest_us) ? budget_us : totals.longest_us;
    }
    totals.utilisation += (((uint64_t)budget_us * 1000000u) + period_us - 1u) / period_us;
    return totals;
}

/* The first rule that a set breaks, or KEEL_OK. */
static keel_status_t verdict(const totals_t *totals, const keel_scheduler_config_t *config)
{
    const uint64_t guard_us = config->guard_us;

    if ((totals->demand_us > 0u) && ((totals->demand_us + (2u * guard_us)) > totals->shortest_us)) {
        return KEEL_ERR_REALTIME_DEMAND;
    }
    if ((totals->longest_us > 0u) && ((totals->longest_us + guard_us) > totals->gap_us)) {
        return KEEL_ERR_BUDGET_GAP;
    }
    return (totals->utilisation > config->utilisation_limit) ? KEEL_ERR_UTILISATION : KEEL_OK;
}

/* The first task with which a scheduler's set breaks a rule, or how many there are; the reason; and
 * what the tasks before it come to. */
static keel_status_t verdict_on_all(const keel_scheduler_t *scheduler, uint32_t *offender,
                                    totals_t *totals)
{
    keel_status_t status = KEEL_OK;

    *totals = no_totals;
    *offender = 0u;
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint32_t x = slot_at(i);

        if ((status == KEEL_OK) && (i < scheduler->queue.count)) {
            const totals_t with = totals_and(*totals, scheduler->queue.priority[x],
                                             scheduler->queue.period_us[x],
                                             scheduler->queue.budget_us[x]);

            status = verdict(&with, &scheduler->config);
            if (status == KEEL_OK) {
                *totals = with;
                (*offender)++;
            }
        }
    }
    return status;
}

#endif
