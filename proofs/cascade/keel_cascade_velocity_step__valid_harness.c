// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --refine
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step drive_with
//
// Any valid cascade, any bit pattern of what it is told: tilt and thrust are within their limits,
// and the cascade stays valid. What they are is in keel_cascade_velocity_step_harness. Where the
// stage says of an axis that it is at its limit, which the axis does not say itself, it has not
// asked the axis to go there: the one half of CAS_011_fence that is not in
// keel_cascade_velocity_step__fence_harness.
#include "cascade_proof.h"

#define ASKED_MOST 3u

static keel_cascade_t cascade;
static keel_cascade_limit_t limit_of[ASKED_MOST];
static float setpoint_of[ASKED_MOST];
static uint32_t asked_for;

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const keel_cascade_axis_t before = *axis;

    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    __CPROVER_assert(asked_for < ASKED_MOST, "CAS_011_axes: north, east and climb");
    *axis = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &before, input));
    setpoint_of[asked_for] = input->setpoint;
    limit_of[asked_for] = axis->limit;
    asked_for++;
}

/* Of the axis that was asked as the one of this number. */
static bool stays_away(uint32_t number)
{
    const keel_cascade_limit_t limit = cascade.axis[KEEL_CASCADE_NORTH_SPEED + number].limit;
    const bool above = limit.at_max && !limit_of[number].at_max;
    const bool below = limit.at_min && !limit_of[number].at_min;

    return (!above || !(setpoint_of[number] > 0.0f)) && (!below || !(setpoint_of[number] < 0.0f));
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
    __CPROVER_assert(asked_for == ASKED_MOST, "CAS_011_axes: north, east and climb");
    __CPROVER_assert(stays_away(0u) && stays_away(1u) && stays_away(2u),
                     "CAS_011_stays: not asked to go to a side that is near");
}
