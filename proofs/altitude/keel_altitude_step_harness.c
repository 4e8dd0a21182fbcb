// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/altitude.c specs/model/altitude.c
// covers: keel_altitude_step model_altitude_step
// replaces: keel_axis_step
//
// Any estimator with limits that are numbers, any bit pattern for all that was measured: the same
// as the model's, bit for bit, whatever a step of the axis comes to. The solver sees that both
// compute the same only where nothing else is asked: all that a step calls is reached in
// keel_altitude_step__points_harness.
#include "../../specs/model/altitude.h"
#include "../axis/axis_told.h"
#include "altitude_proof.h"

void keel_altitude_step_harness(void)
{
    keel_altitude_sample_t sample = any_altitude_sample();
    const keel_altitude_sample_t before = sample;
    keel_altitude_t altitude = any_altitude_at_all();
    keel_altitude_t model = altitude;

    __CPROVER_assume(keel_axis_step_may(&altitude.axis));

    model_altitude_step(&model, &before);
    keel_altitude_step(&altitude, &sample);

    __CPROVER_assert(told == asked, "ALT_007_steps: as many steps of the axis as the model makes");
    __CPROVER_assert(altitude_same(&altitude, &model),
                     "ALT_007_model: every field is what the model says");
    __CPROVER_assert(altitude_sample_same(&sample, &before),
                     "ALT_007_frame: the sample is not written");
}
