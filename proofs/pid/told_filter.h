/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file told_filter.h
 * @brief What stands for keel_filter_init, and for its model: any low-pass that its contract
 *        allows, or any refusal. When the model makes one, the code must make the same.
 */
#ifndef TOLD_FILTER_H
#define TOLD_FILTER_H

#include "../common/filter_contracts.h"

/* What the model was asked, and the answer. */
static float asked_rate_hz;
static float asked_cutoff_hz;
static keel_filter_t made;
static keel_status_t making;

static void tell_filter(void)
{
    made = nondet_filter();
    making = nondet_bool() ? KEEL_OK : (nondet_bool() ? KEEL_ERR_RATE : KEEL_ERR_CUTOFF);
}

static void take_made(keel_filter_t *filter)
{
    if (making == KEEL_OK) {
        *filter = made;
    }
}

keel_status_t model_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    asked_rate_hz = rate_hz;
    asked_cutoff_hz = cutoff_hz;
    take_made(filter);
    return making;
}

keel_status_t keel_filter_init_stand_in(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    const keel_filter_t before = *filter;

    __CPROVER_assert(keel_filter_init_may(), "precondition: keel_filter_init");
    __CPROVER_assert(float_same(rate_hz, asked_rate_hz) && float_same(cutoff_hz, asked_cutoff_hz),
                     "PID_002_asked: a low-pass for the rate and the cut-off as they are");
    take_made(filter);
    __CPROVER_assume(keel_filter_init_does(making, filter, &before, rate_hz));
    return making;
}

#endif
