// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_step model_attitude_step
//
// Any estimator at all, any bit pattern for all that was measured: the same as the model's, bit for
// bit. The solver sees that both compute the same only where nothing else is asked: all that a
// step calls is reached in keel_attitude_step__reached_harness.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

void keel_attitude_step_harness(void)
{
    keel_attitude_sample_t sample = any_sample();
    const keel_attitude_sample_t before = sample;
    keel_attitude_t attitude = any_attitude_at_all();
    keel_attitude_t model = attitude;

    keel_attitude_step(&attitude, &sample);
    model_attitude_step(&model, &before);

    __CPROVER_assert(attitude_same(&attitude, &model),
                     "ATT_009_model: every field is what the model says");
    __CPROVER_assert(sample_same(&sample, &before), "ATT_009_frame: the sample is not written");
}
