// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/axis.c specs/model/axis.c
// covers: keel_axis_step model_axis_step
//
// Any axis at all, any bit pattern for all that was measured: the same as the model's, bit for bit.
// The solver sees that both compute the same only where nothing else is asked: all that a step
// calls is reached in keel_axis_step__points_harness.
#include "../../specs/model/axis.h"
#include "axis_proof.h"

void keel_axis_step_harness(void)
{
    keel_axis_sample_t sample = any_axis_sample();
    const keel_axis_sample_t before = sample;
    keel_axis_t axis = any_axis_at_all();
    keel_axis_t model = axis;

    keel_axis_step(&axis, &sample);
    model_axis_step(&model, &before);

    __CPROVER_assert(axis_same(&axis, &model), "AXI_004_model: every field is what the model says");
    __CPROVER_assert(axis_sample_same(&sample, &before),
                     "AXI_004_frame: the sample is not written");
}
