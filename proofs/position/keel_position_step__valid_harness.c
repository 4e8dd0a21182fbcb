// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/position.c
// covers: keel_position_step longitude_eastwards is_near metres_of
// replaces: keel_axis_step
//
// Any valid estimator, any bit pattern for all that was measured: the contract of a step, clause by
// clause; no operation overflows or gives a NaN.
#include "../axis/axis_stepped.h"
#include "position_proof.h"

static bool keeps_within(const keel_axis_t *axis)
{
    return within(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           within(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
}

void keel_position_step__valid_harness(void)
{
    const keel_position_sample_t sample = any_position_sample();
    keel_position_t position = any_position_at_all();
    const bool usable = sample.fix.is_valid && position.has_origin &&
                        within(sample.fix.accuracy, 0.0f, position.config.accuracy);
    const keel_axis_t *const north = &position.north;
    const keel_axis_t *const east = &position.east;

    __CPROVER_assume(position_valid(&position));

    keel_position_step(&position, &sample);

    __CPROVER_assert(!sample.has_fix || usable ||
                         (is_told(north, KEEL_AXIS_UNUSABLE) && is_told(east, KEEL_AXIS_UNUSABLE)),
                     "POS_005_unusable: a fix that cannot be used is told");
    __CPROVER_assert(sample.has_fix ||
                         (!is_told(north, KEEL_AXIS_FIXED) && !is_told(east, KEEL_AXIS_FIXED)),
                     "POS_005_none: none is taken when none came");
    __CPROVER_assert(keeps_within(north), "POS_008_north: within the limits");
    __CPROVER_assert(keeps_within(east), "POS_008_east: within the limits");
    __CPROVER_assert(position.quality ==
                         ((north->quality < east->quality) ? north->quality : east->quality),
                     "POS_009_worse: the quality is that of the worse direction");
}
