/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file admission_contracts.h
 * @brief What the functions of admission.h ask for and do, as far as the scheduler needs to know.
 *
 * Their own harnesses prove that they keep these; in the harnesses of the scheduler they stand in
 * for the functions. That they do what the model does is more than that, and asserted beside it.
 */
#ifndef ADMISSION_CONTRACTS_H
#define ADMISSION_CONTRACTS_H

#include "keel/internal/rtos/admission.h"
#include "keel_proof.h"

static bool totals_same(const keel_admission_t *left, const keel_admission_t *right)
{
    return (left->guard_us == right->guard_us) &&
           (left->utilisation_limit_ppm == right->utilisation_limit_ppm) &&
           (left->utilisation_ppm == right->utilisation_ppm) &&
           (left->realtime_demand_us == right->realtime_demand_us) &&
           (left->shortest_realtime_us == right->shortest_realtime_us) &&
           (left->shortest_gap_us == right->shortest_gap_us) &&
           (left->longest_other_us == right->longest_other_us) && (left->tasks == right->tasks);
}

static bool keel_admission_admit_may(const keel_admission_t *totals, uint32_t period_us,
                                     uint32_t budget_us)
{
    return (totals->tasks < KEEL_QUEUE_CAPACITY) && (0u < period_us) &&
           (period_us < KEEL_PERIOD_LIMIT_US) && (0u < budget_us);
}

static bool keel_admission_admit_does(keel_status_t status, const keel_admission_t *totals,
                                      const keel_admission_t *modelled)
{
    return ((status == KEEL_OK) || (status == KEEL_ERR_REALTIME_DEMAND) ||
            (status == KEEL_ERR_BUDGET_GAP) || (status == KEEL_ERR_UTILISATION)) &&
           totals_same(totals, modelled);
}

static bool keel_admission_queue_may(const keel_admission_t *totals, const keel_queue_t *queue)
{
    return (totals->tasks == 0u) && (queue->count <= KEEL_QUEUE_CAPACITY);
}

/* All are admitted, or the first that is not is told. */
static bool keel_admission_queue_does(keel_status_t status, const keel_admission_t *totals,
                                      const keel_queue_t *queue)
{
    return (totals->tasks <= queue->count) &&
           ((status == KEEL_OK) == (totals->tasks == queue->count));
}

#endif
