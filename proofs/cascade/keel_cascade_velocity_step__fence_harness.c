// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step
//
// Any cascade whose axes of this stage are valid, any bit pattern of all else and of what it is
// told: where a side of the fence is near, by the formula of cascade.h as rounded, the stage says of
// the axis that it is at its limit, whatever the axis says. That the stage does not ask an axis to
// go where it says so is in keel_cascade_velocity_step__valid_harness, that the axis does not go
// where it is not asked to go in keel_cascade_axis_step_harness. By hand: whether a side is near is
// found before the axis is asked, so it does not hang on what the axis says.
#include "cascade_proof.h"

#define ASKED_MOST 3u

static keel_cascade_t cascade;
static uint32_t asked_for;

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const keel_cascade_axis_t before = *axis;

    __CPROVER_assert(asked_for < ASKED_MOST, "CAS_011_axes: north, east and climb");
    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    *axis = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &before, input));
    asked_for++;
}

/* cascade_near */
static bool near_here(const keel_cascade_fence_t *fence, float way, float speed)
{
    const float fastest = speed + fence->gain;
    const float left = way - (fence->reaction_s * (speed + fence->half_gain));
    const float square = (fastest > 0.0f) ? (fastest * fastest) : 0.0f;

    return !(square <= (fence->twice_braking * left));
}

/* What cascade_fenced says of limits. */
static bool fenced_here(uint32_t axis, float position, float speed)
{
    const keel_cascade_limit_t limit = cascade.axis[axis].limit;
    const float reach = cascade.axis[axis + 3u].reach;
    const bool above = near_here(&cascade.fence, reach - position, speed);
    const bool below = near_here(&cascade.fence, reach + position, -speed);

    return (!above || limit.at_max) && (!below || limit.at_min);
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
    __CPROVER_assert(fenced_here(KEEL_CASCADE_NORTH_SPEED, estimate.position.north,
                                 estimate.velocity.north),
                     "CAS_011_fence: a side in the north or south that is near is told");
    __CPROVER_assert(fenced_here(KEEL_CASCADE_EAST_SPEED, estimate.position.east,
                                 estimate.velocity.east),
                     "CAS_011_fence: one in the east or west");
    __CPROVER_assert(fenced_here(KEEL_CASCADE_CLIMB, estimate.position.up, estimate.velocity.up),
                     "CAS_011_fence: and one above or below");
}
