// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 11 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_finish keel_calibration_field_axis middle_of
// covers: model_calibration_field_finish model_calibration_field_axis centre lies_in
//
// Chosen calibrations, each in a case of its own: the same as the model's. All of them are dealt
// with in keel_calibration_field_finish_harness; wrong bodies are refuted here, for where floats
// differ z3 finds no example.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

void keel_calibration_field_finish__points_harness(void)
{
    for (unsigned point = 0u; point < FIELD_POINTS; point++) {
        keel_calibration_field_t field;
        keel_calibration_field_t model;
        keel_status_t status;

        make_field_point(point, &field);
        model = field;

        status = keel_calibration_field_finish(&field);

        __CPROVER_assert(status == model_calibration_field_finish(&model),
                         "CAL_012_exact: taken or refused as the model says");
        __CPROVER_assert(field_same(&field, &model),
                         "CAL_012_points: every field is what the model says");
    }
}
