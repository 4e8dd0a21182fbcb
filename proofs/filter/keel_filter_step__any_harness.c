// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c
// covers: keel_filter_step is_sample
//
// Any valid filter, any bit pattern: one step of the induction that bounds the states. What the
// step computes is in keel_filter_step_harness.
#include "../common/filter_contracts.h"
#include "../common/unchanged.h"

void keel_filter_step__any_harness(void)
{
    const float input = nondet_float();
    keel_filter_t filter;
    keel_filter_t before;
    keel_status_t status;

    any_filter(&filter);
    before = filter;
    __CPROVER_assume(keel_filter_step_may(&filter));

    status = keel_filter_step(&filter, input);

    __CPROVER_assert(keel_filter_step_does(status, &filter, &before, input),
                     "FLT_005_any: what stands in for it elsewhere");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_INPUT),
                     "FLT_005_status: taken or refused");
    __CPROVER_assert(filter_valid_here(&filter), "FLT_005_bounded: states and output in bounds");
    __CPROVER_assert((status != KEEL_OK) || filter_input_here(input),
                     "FLT_006_input: what is taken is in range");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&filter, &before, sizeof(filter)),
                     "STA_001_kept: a refusal changes nothing");
}
