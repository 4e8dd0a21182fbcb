// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_velocity_step
//
// Any valid cascade, any bit pattern of what it is told: where a side of the fence is near, by the
// formula of cascade.h as rounded, an axis is not asked to go there, and says that it is at its
// limit. What an axis does is unknown; that it does not go where it is not asked to go is in
// keel_cascade_axis_step_harness.
#include "cascade_proof.h"

static keel_cascade_t cascade;
static float asked_of[AXES];

static uint32_t index_of(const keel_cascade_axis_t *axis)
{
    uint32_t index = 0u;

    for (uint32_t i = 0u; i < AXES; i++) {
        index = (axis == &cascade.axis[i]) ? i : index;
    }
    return index;
}

void keel_cascade_axis_step_stand_in(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const keel_cascade_axis_t before = *axis;

    __CPROVER_assert(keel_cascade_axis_step_may(axis), "precondition: keel_cascade_axis_step");
    asked_of[index_of(axis)] = input->setpoint;
    *axis = any_axis();
    __CPROVER_assume(keel_cascade_axis_step_does(axis, &before, input));
}

/* cascade_near */
static bool near_here(const keel_cascade_fence_t *fence, float way, float speed)
{
    const float fastest = speed + fence->gain;
    const float left = way - (fence->reaction_s * (speed + fence->half_gain));

    return !(((fastest > 0.0f) ? (fastest * fastest) : 0.0f) <= (fence->twice_braking * left));
}

/* cascade_fenced */
static bool fenced_here(uint32_t i, float position, float speed)
{
    const keel_cascade_limit_t limit = cascade.axis[i].limit;
    const float reach = cascade.axis[i + 3u].reach;
    const bool above = near_here(&cascade.fence, reach - position, speed);
    const bool below = near_here(&cascade.fence, reach + position, -speed);

    return (!above || (limit.at_max && !(asked_of[i] > 0.0f))) &&
           (!below || (limit.at_min && !(asked_of[i] < 0.0f)));
}

void keel_cascade_velocity_step__fence_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    const keel_cascade_estimate_t estimate = any_estimate();

    any_cascade(&cascade);
    __CPROVER_assume(cascade_valid_here(&cascade));

    keel_cascade_velocity_step(&cascade, asked, &estimate);

    __CPROVER_assert(fenced_here(KEEL_CASCADE_NORTH_SPEED, estimate.position.north,
                                 estimate.velocity.north),
                     "CAS_011_fence: not towards a side in the north or south that is near");
    __CPROVER_assert(fenced_here(KEEL_CASCADE_EAST_SPEED, estimate.position.east,
                                 estimate.velocity.east),
                     "CAS_011_fence: nor in the east or west");
    __CPROVER_assert(fenced_here(KEEL_CASCADE_CLIMB, estimate.position.up, estimate.velocity.up),
                     "CAS_011_fence: nor above or below");
}
