// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step model_cascade_velocity_step
//
// Any cascade whose axes of this stage are valid, any bit pattern of all else and of what it is
// told; what an axis does is unknown: to the model it is anything at all, the code must ask the
// same of the same axis, and is told the same. The solver sees that both compute the same only
// where nothing else is asked: all that a step calls is reached in
// keel_cascade_velocity_step__points_harness, bounds are in
// keel_cascade_velocity_step__valid_harness, the fence is in
// keel_cascade_velocity_step__fence_harness.
#include "asked_in_order.h"

void keel_cascade_velocity_step_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    keel_cascade_estimate_t estimate = any_estimate();
    const keel_cascade_estimate_t before = estimate;

    any_cascade(&cascade);
    model = cascade;
    __CPROVER_assume(keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_NORTH_SPEED]) &&
                     keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_EAST_SPEED]) &&
                     keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_CLIMB]));
    model_cascade_velocity_step(&model, asked, &before);

    keel_cascade_velocity_step(&cascade, asked, &estimate);

    __CPROVER_assert(told == asked_for, "CAS_010_axes: as many axes as the model steps");
    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_010_model: every field is what the model says");
    __CPROVER_assert(estimate_same(&estimate, &before), "CAS_010_frame: the estimate is only read");
}
