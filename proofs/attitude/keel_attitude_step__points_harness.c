// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 47 --external-sat-solver cadical
// checks: assertions
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_step model_attitude_step
//
// Chosen estimators and samples, each in a case of its own: the same as the model's. All of them
// are dealt with in keel_attitude_step_harness; wrong bodies are refuted here, for where floats
// differ z3 finds no example.
#include "../../specs/model/attitude.h"
#include "attitude_points.h"

void keel_attitude_step__points_harness(void)
{
    for (unsigned point = 0u; point < POINTS; point++) {
        keel_attitude_t attitude;
        keel_attitude_t model;
        keel_attitude_sample_t sample;

        make_point(point, &attitude, &sample);
        model = attitude;

        keel_attitude_step(&attitude, &sample);
        model_attitude_step(&model, &sample);

        __CPROVER_assert(attitude_same(&attitude, &model),
                         "ATT_009_points: every field is what the model says");
    }
}
