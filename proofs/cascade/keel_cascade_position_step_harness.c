// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_position_step lead_with is_asked_for is_flown asks_for
// covers: model_cascade_position_step asked_below setpoint_of axis_output output_of
//
// Any valid cascade, any bit pattern of what it is told; what an axis does is unknown
// (asked_axes.h).
#include "asked_axes.h"

void keel_cascade_position_step_harness(void)
{
    const keel_cascade_vector_t asked = nondet_cascade_vector();
    keel_cascade_estimate_t estimate = any_estimate();
    const keel_cascade_estimate_t before = estimate;

    begin_alike();
    model_cascade_position_step(&model, asked, &before);

    keel_cascade_position_step(&cascade, asked, &estimate);

    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_013_model: every field is what the model says");
    __CPROVER_assert(estimate_same(&estimate, &before), "CAS_013_frame: the estimate is only read");
    __CPROVER_assert(magnitude(cascade.velocity.north,
                               cascade.axis[KEEL_CASCADE_NORTH_SPEED].reach) &&
                         magnitude(cascade.velocity.east,
                                   cascade.axis[KEEL_CASCADE_EAST_SPEED].reach) &&
                         magnitude(cascade.velocity.up, cascade.axis[KEEL_CASCADE_CLIMB].reach),
                     "CAS_013_speeds: within what the velocity stage takes");
    __CPROVER_assert(cascade_valid_here(&cascade), "CAS_004_position: the cascade stays valid");
}
