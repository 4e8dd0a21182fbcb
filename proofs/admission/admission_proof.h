/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file admission_proof.h
 * @brief What the harnesses of admission share: any totals.
 */
#ifndef ADMISSION_PROOF_H
#define ADMISSION_PROOF_H

#include "../common/admission_contracts.h"

/* Within the widths that totals have, valid or not. */
static keel_admission_t any_totals(void)
{
    keel_admission_t totals;

    totals.guard_us = any_bits64(31u);
    totals.utilisation_limit_ppm = any_bits64(20u);
    totals.utilisation_ppm = any_bits64(20u);
    totals.realtime_demand_us = any_bits64(31u);
    totals.shortest_realtime_us = nondet_u64();
    totals.shortest_gap_us = nondet_u64();
    totals.longest_other_us = any_bits64(32u);
    totals.tasks = any_below(CAPACITY);
    return totals;
}

#endif
