// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/filter.c
// covers: keel_filter_step is_sample
//
// Any valid filter, any bit pattern: what a step computes, each sum and product rounded as the
// contract has it. The solver sees that both compute the same where nothing else is asked.
#include "../common/filter_contracts.h"

void keel_filter_step__rounded_harness(void)
{
    const float input = nondet_float();
    keel_filter_t filter;
    keel_filter_t before;
    keel_status_t status;
    float difference;
    float output;
    float s1;

    any_filter(&filter);
    before = filter;
    __CPROVER_assume(keel_filter_step_may(&filter));
    difference = input - before.s2;
    output = before.s2 + ((before.b * before.s1) + (before.a * difference));
    s1 = (before.c * before.s1) + (before.b * difference);

    status = keel_filter_step(&filter, input);

    __CPROVER_assert((status != KEEL_OK) || (filter.output == output),
                     "FLT_009_output: what is put out");
    __CPROVER_assert((status != KEEL_OK) || (filter.s1 == s1), "FLT_009_s1: the first state");
}
