// SPDX-License-Identifier: Apache-2.0
// checks: assertions
// sources: src/flight/filter.c
// covers: keel_filter_init set_coefficients tangent
//
// Any bit pattern for both frequencies: which are refused and how, and that a filter begins at
// rest. Its coefficients are in keel_filter_init__any_harness.
#include "../common/filter_refusals.h"

void keel_filter_init__clauses_harness(void)
{
    const float rate_hz = nondet_float();
    const float cutoff_hz = nondet_float();
    const bool rate = filter_rate_here(rate_hz);
    const bool cutoff = filter_cutoff_here(rate_hz, cutoff_hz);
    keel_filter_t filter = nondet_filter();
    const keel_filter_t before = filter;
    const keel_status_t status = keel_filter_init(&filter, rate_hz, cutoff_hz);

    __CPROVER_assert(rate || (status == KEEL_ERR_RATE), "FLT_001_rate: a bad rate is refused");
    __CPROVER_assert(!rate || cutoff || (status == KEEL_ERR_CUTOFF),
                     "FLT_001_cutoff: a bad cut-off is refused");
    __CPROVER_assert(!rate || !cutoff || (status == KEEL_OK), "FLT_001_ok: all others are taken");
    __CPROVER_assert(status == filter_init_answer(rate_hz, cutoff_hz),
                     "FLT_001_any: what stands in for it elsewhere");
    __CPROVER_assert((rate && cutoff) || filter_same(&filter, &before),
                     "FLT_001_unchanged: what is refused changes nothing");
    __CPROVER_assert(!rate || !cutoff ||
                         ((filter.s1 == 0.0f) && (filter.s2 == 0.0f) && (filter.output == 0.0f)),
                     "FLT_003_rest: a filter begins at rest at 0");
}
