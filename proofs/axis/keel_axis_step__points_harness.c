// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/flight/axis.c specs/model/axis.c
// covers: keel_axis_step predict_state one_up_to fix_counts judge_fix judge_jump set_to_fix
// covers: correct_state quality_of model_axis_step integrate fix_usable begin_at make_up meet_fix
// covers: meet_jump next_in lies_in
//
// Chosen axes and samples, each in a case of its own: the same as the model's. All of them are
// dealt with in keel_axis_step_harness; wrong bodies are refuted here, for where floats differ z3
// finds no example.
#include "../../specs/model/axis.h"
#include "axis_points.h"

void keel_axis_step__points_harness(void)
{
    for (unsigned point = 0u; point < POINTS; point++) {
        keel_axis_t axis;
        keel_axis_t model;
        keel_axis_sample_t sample;

        make_point(point, &axis, &sample);
        model = axis;

        keel_axis_step(&axis, &sample);
        model_axis_step(&model, &sample);

        __CPROVER_assert(axis_same(&axis, &model),
                         "AXI_004_points: every field is what the model says");
    }
}
