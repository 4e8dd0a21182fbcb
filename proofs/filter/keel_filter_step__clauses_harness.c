// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/filter.c
// covers: keel_filter_step is_sample
//
// Any valid filter, any bit pattern: what a refused input leaves. The other clauses are in
// keel_filter_step__any_harness, and in keel_filter_step__rounded_harness.
#include "../common/filter_contracts.h"

void keel_filter_step__clauses_harness(void)
{
    const float input = nondet_float();
    keel_filter_t filter;
    keel_filter_t before;
    keel_status_t status;

    any_filter(&filter);
    before = filter;
    __CPROVER_assume(keel_filter_step_may(&filter));

    status = keel_filter_step(&filter, input);

    __CPROVER_assert((status != KEEL_ERR_INPUT) ||
                         ((filter.s1 == before.s1) && (filter.s2 == before.s2) &&
                          (filter.output == before.output)),
                     "FLT_006_held: a refused input moves nothing");
}
