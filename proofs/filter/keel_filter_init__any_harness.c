// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c
// covers: keel_filter_init set_coefficients tangent
//
// Any bit pattern for both frequencies: what is made is valid, and no operation overflows or gives
// a NaN. What the filter is, is in keel_filter_init_harness.
#include "../common/filter_contracts.h"
#include "../common/unchanged.h"

void keel_filter_init__any_harness(void)
{
    const float rate_hz = nondet_float();
    const float cutoff_hz = nondet_float();
    keel_filter_t filter = nondet_filter();
    const keel_filter_t before = filter;
    keel_status_t status;

    __CPROVER_assume(keel_filter_init_may());

    status = keel_filter_init(&filter, rate_hz, cutoff_hz);

    __CPROVER_assert(keel_filter_init_does(status, &filter, &before, rate_hz),
                     "FLT_003_any: what stands in for it elsewhere");
    if (status == KEEL_OK) {
        __CPROVER_assert(filter_coefficients_here(&filter), "FLT_002_coefficients: in range");
        __CPROVER_assert(filter_bounded_here(&filter), "FLT_003_valid: states and output, too");
    } else {
        __CPROVER_assert(unchanged(&filter, &before, sizeof(filter)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
