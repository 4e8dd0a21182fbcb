// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_step model_calibration_rest_step
//
// Any calibration at all, any bit pattern for what was measured: the same as the model's, bit for
// bit. The solver sees that both compute the same only where nothing else is asked: all that a step
// calls is reached in keel_calibration_rest_step__points_harness.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_rest_step_harness(void)
{
    keel_calibration_vector_t sample = nondet_vector();
    const keel_calibration_vector_t before = sample;
    keel_calibration_rest_t rest = any_rest_at_all();
    keel_calibration_rest_t model = rest;

    keel_calibration_rest_step(&rest, sample.axis);
    model_calibration_rest_step(&model, before.axis);

    __CPROVER_assert(rest_same(&rest, &model), "CAL_004_model: every field is what the model says");
    __CPROVER_assert(three_same(sample.axis, before.axis),
                     "CAL_004_frame: the sample is not written");
}
