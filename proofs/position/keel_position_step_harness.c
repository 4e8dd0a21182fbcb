// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/position.c specs/model/position.c
// covers: keel_position_step model_position_step
// replaces: keel_axis_step
//
// Any estimator with limits that are numbers, any bit pattern for all that was measured: the same
// as the model's, bit for bit, whatever the steps of its axes come to. The solver sees that both
// compute the same only where nothing else is asked: all that a step calls is reached in
// keel_position_step__points_harness.
#include "../../specs/model/position.h"
#include "../axis/axis_told.h"
#include "position_proof.h"

void keel_position_step_harness(void)
{
    keel_position_sample_t sample = any_position_sample();
    const keel_position_sample_t before = sample;
    keel_position_t position = any_position_at_all();
    keel_position_t model = position;

    __CPROVER_assume(keel_axis_step_may(&position.north) && keel_axis_step_may(&position.east));

    model_position_step(&model, &before);
    keel_position_step(&position, &sample);

    __CPROVER_assert(told == asked, "POS_007_steps: as many steps of axes as the model makes");
    __CPROVER_assert(position_same(&position, &model),
                     "POS_007_model: every field is what the model says");
    __CPROVER_assert(position_sample_same(&sample, &before),
                     "POS_007_frame: the sample is not written");
}
