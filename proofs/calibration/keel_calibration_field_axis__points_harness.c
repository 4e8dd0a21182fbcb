// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 31 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_axis middle_of model_calibration_field_axis centre lies_in
//
// Chosen calibrations, every axis of each: the same as the model's, with all checks.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

void keel_calibration_field_axis__points_harness(void)
{
    for (uint32_t point = 0u; point < (FIELD_POINTS * KEEL_CALIBRATION_AXES); point++) {
        const uint32_t axis = point % KEEL_CALIBRATION_AXES;
        keel_calibration_field_t field;

        make_field_point(point / KEEL_CALIBRATION_AXES, &field);

        __CPROVER_assert(keel_calibration_field_axis(&field, axis) ==
                             model_calibration_field_axis(&field, axis),
                         "CAL_011_points: the result is what the model says");
    }
}
