// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/calibration.c
// covers: keel_calibration_rest_step are_within set_axes begin_run continue_run break_run
// covers: axes_beyond end_rest one_up
//
// Any valid calibration, any bit pattern for what was measured: a step keeps it valid, and no
// operation on it overflows or gives a NaN.
#include "calibration_proof.h"

void keel_calibration_rest_step__valid_harness(void)
{
    const keel_calibration_vector_t sample = nondet_vector();
    keel_calibration_rest_t rest = any_rest_at_all();

    __CPROVER_assume(rest_valid(&rest));

    keel_calibration_rest_step(&rest, sample.axis);

    __CPROVER_assert(rest_valid(&rest), "CAL_013_rest: a step keeps a calibration valid");
}
