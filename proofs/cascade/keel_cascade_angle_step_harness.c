// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade.c
// replaces: keel_cascade_axis_step
// covers: keel_cascade_angle_step lead_with is_asked_for is_flown asks_for
// covers: model_cascade_angle_step asked_below setpoint_of axis_output output_of
//
// Any valid cascade, any bit pattern of what it is told; what an axis does is unknown
// (asked_axes.h).
#include "asked_axes.h"

void keel_cascade_angle_step_harness(void)
{
    const keel_cascade_tilt_t asked = nondet_tilt();
    const keel_attitude_vector_t down = nondet_vector();
    const bool valid = nondet_bool();

    begin_alike();
    model_cascade_angle_step(&model, asked, down, valid);

    keel_cascade_angle_step(&cascade, asked, down, valid);

    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_009_model: every field is what the model says");
    __CPROVER_assert(magnitude(cascade.rates.roll, cascade.axis[KEEL_CASCADE_ROLL_RATE].reach) &&
                         magnitude(cascade.rates.pitch,
                                   cascade.axis[KEEL_CASCADE_PITCH_RATE].reach),
                     "CAS_009_rates: within what the rate stage takes");
    __CPROVER_assert(cascade_valid_here(&cascade), "CAS_004_angle: the cascade stays valid");
}
