// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step model_cascade_velocity_step
//
// Any valid cascade, any bit pattern of what it is told; what an axis does is unknown
// (asked_axes.h). The solver sees that both compute the same only where nothing else is asked: all
// that a step calls is reached in keel_cascade_velocity_step__points_harness, bounds and fence are
// in keel_cascade_velocity_step__valid_harness.
#include "asked_axes.h"

void keel_cascade_velocity_step_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    keel_cascade_estimate_t estimate = any_estimate();
    const keel_cascade_estimate_t before = estimate;

    begin_same();
    model_cascade_velocity_step(&model, asked, &before);

    keel_cascade_velocity_step(&cascade, asked, &estimate);

    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_010_model: every field is what the model says");
    __CPROVER_assert(estimate_same(&estimate, &before), "CAS_010_frame: the estimate is only read");
}
