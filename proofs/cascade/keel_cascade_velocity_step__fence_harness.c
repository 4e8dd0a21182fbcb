// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step
//
// Any cascade whose axes of this stage are valid, any bit pattern of all else and of what it is
// told: where a side of the fence is near, by the formula of cascade.h as rounded, an axis is not
// asked to go there, and says that it is at its limit. What an axis does is unknown; that it does
// not go where it is not asked to go is in keel_cascade_axis_step_harness.
#include "cascade_proof.h"

#define ASKED_MOST 3u

static keel_cascade_t cascade;
static float setpoint_of[ASKED_MOST];
static uint32_t asked_for;

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const keel_cascade_axis_t before = *axis;

    __CPROVER_assert(asked_for < ASKED_MOST, "CAS_011_axes: north, east and climb");
    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    setpoint_of[asked_for] = input->setpoint;
    *axis = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &before, input));
    asked_for++;
}

/* cascade_near */
static bool near_here(const keel_cascade_fence_t *fence, float way, float speed)
{
    const float fastest = speed + fence->gain;
    const float left = way - (fence->reaction_s * (speed + fence->half_gain));

    return !(((fastest > 0.0f) ? (fastest * fastest) : 0.0f) <= (fence->twice_braking * left));
}

/* cascade_fenced, of the axis that was asked as the one of this number. */
static bool fenced_here(uint32_t number, float position, float speed)
{
    const uint32_t axis = KEEL_CASCADE_NORTH_SPEED + number;
    const keel_cascade_limit_t limit = cascade.axis[axis].limit;
    const float reach = cascade.axis[axis + 3u].reach;
    const bool above = near_here(&cascade.fence, reach - position, speed);
    const bool below = near_here(&cascade.fence, reach + position, -speed);

    return (!above || (limit.at_max && !(setpoint_of[number] > 0.0f))) &&
           (!below || (limit.at_min && !(setpoint_of[number] < 0.0f)));
}

void keel_cascade_velocity_step__fence_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    const keel_cascade_estimate_t estimate = any_estimate();

    any_cascade(&cascade);
    __CPROVER_assume(keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_NORTH_SPEED]) &&
                     keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_EAST_SPEED]) &&
                     keel_cascade_axis_step_may(&cascade.axis[KEEL_CASCADE_CLIMB]));

    keel_cascade_velocity_step(&cascade, asked, &estimate);

    __CPROVER_assert(asked_for == ASKED_MOST, "CAS_011_axes: north, east and climb");
    __CPROVER_assert(fenced_here(0u, estimate.position.north, estimate.velocity.north),
                     "CAS_011_fence: not towards a side in the north or south that is near");
    __CPROVER_assert(fenced_here(1u, estimate.position.east, estimate.velocity.east),
                     "CAS_011_fence: nor in the east or west");
    __CPROVER_assert(fenced_here(2u, estimate.position.up, estimate.velocity.up),
                     "CAS_011_fence: nor above or below");
}
