// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_step are_within set_axes begin_run continue_run break_run one_up
// covers: axes_beyond end_rest
// covers: model_calibration_rest_step all_lie_in lies_in counted_once give_up compare_with_first
// covers: judge_mean
//
// Chosen calibrations and samples, each in a case of its own: the same as the model's. All of them
// are dealt with in keel_calibration_rest_step_harness; wrong bodies are refuted here, for where
// floats differ z3 finds no example.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

void keel_calibration_rest_step__points_harness(void)
{
    for (unsigned point = 0u; point < REST_POINTS; point++) {
        keel_calibration_rest_t rest;
        keel_calibration_rest_t model;
        keel_calibration_vector_t sample;

        make_rest_point(point, &rest, &sample);
        model = rest;

        keel_calibration_rest_step(&rest, sample.axis);
        model_calibration_rest_step(&model, sample.axis);

        __CPROVER_assert(rest_same(&rest, &model),
                         "CAL_004_points: every field is what the model says");
    }
}
