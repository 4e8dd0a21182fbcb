// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --refine
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step drive_with
//
// Any valid cascade, any bit pattern of what it is told: tilt and thrust are within their limits,
// and the cascade stays valid. What they are is in keel_cascade_velocity_step_harness.
#include "cascade_proof.h"

static keel_cascade_t cascade;

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const keel_cascade_axis_t before = *axis;

    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    *axis = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &before, input));
}

void keel_cascade_velocity_step__valid_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    const keel_cascade_estimate_t estimate = any_estimate();

    any_cascade(&cascade);
    __CPROVER_assume(cascade_valid_here(&cascade));

    keel_cascade_velocity_step(&cascade, asked, &estimate);

    __CPROVER_assert(magnitude(cascade.tilt.roll, cascade.axis[KEEL_CASCADE_ROLL].reach) &&
                         magnitude(cascade.tilt.pitch, cascade.axis[KEEL_CASCADE_PITCH].reach),
                     "CAS_010_tilt: within what the angle stage takes");
    __CPROVER_assert(within(cascade.thrust, 0.0f, 1.0f), "CAS_010_thrust: the mixer takes it");
    __CPROVER_assert(cascade_valid_here(&cascade), "CAS_004_velocity: the cascade stays valid");
}
