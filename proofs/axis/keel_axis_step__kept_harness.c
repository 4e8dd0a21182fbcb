// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/axis.c
// covers: keel_axis_step
//
// As keel_axis_step__any_harness: what a step remembers of a jump, whatever else it does.
#include "axis_proof.h"

void keel_axis_step__kept_harness(void)
{
    const keel_axis_sample_t sample = any_axis_sample();
    keel_axis_t axis = any_axis_at_all();
    const keel_axis_t before = axis;

    __CPROVER_assume(keel_axis_step_may(&axis));

    keel_axis_step(&axis, &sample);

    __CPROVER_assert(is_told(&axis, KEEL_AXIS_JUMPED) || !within(before.jump, -FLT_MAX, FLT_MAX) ||
                         (axis.jump == before.jump),
                     "AXI_013_kept: without a jump the place of the last one stays");
}
