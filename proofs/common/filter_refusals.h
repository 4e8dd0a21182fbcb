/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file filter_refusals.h
 * @brief Which rate and cut-off keel_filter_init takes, and how it answers: what its own harness
 *        proves, and what stands in for it where the answer decides.
 *
 * In double precision, where both products are exact for any single-precision operands: these are
 * the comparisons of the contract, which are of real numbers.
 */
#ifndef FILTER_REFUSALS_H
#define FILTER_REFUSALS_H

#include "keel_flight_proof.h"

/* filter_rate */
static bool filter_rate_here(float rate_hz)
{
    return within(rate_hz, KEEL_FILTER_RATE_MIN_HZ, KEEL_FILTER_RATE_MAX_HZ);
}

/* filter_cutoff; no NaN and no infinity is between two finite numbers. */
static bool filter_cutoff_here(float rate_hz, float cutoff_hz)
{
    return ((2.0 * (double)cutoff_hz) < (double)rate_hz) &&
           (((double)rate_hz * (double)KEEL_FILTER_RATIO_MIN) <= (double)cutoff_hz);
}

/* The clauses FLT_001_rate, FLT_001_cutoff and FLT_001_ok together. */
static keel_status_t filter_init_answer(float rate_hz, float cutoff_hz)
{
    if (!filter_rate_here(rate_hz)) {
        return KEEL_ERR_RATE;
    }
    return filter_cutoff_here(rate_hz, cutoff_hz) ? KEEL_OK : KEEL_ERR_CUTOFF;
}

#endif
