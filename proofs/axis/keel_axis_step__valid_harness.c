// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/axis.c
// covers: keel_axis_step predict_state one_up_to fix_counts judge_fix judge_jump set_to_fix
// covers: correct_state quality_of
//
// Any valid axis, any bit pattern for all that was measured: a step keeps it valid, and no
// operation on it overflows or gives a NaN.
#include "axis_proof.h"

void keel_axis_step__valid_harness(void)
{
    const keel_axis_sample_t sample = any_axis_sample();
    keel_axis_t axis = any_axis_at_all();

    __CPROVER_assume(axis_valid(&axis));

    keel_axis_step(&axis, &sample);

    __CPROVER_assert(axis_valid(&axis), "AXI_006_valid: a step keeps an axis valid");
}
