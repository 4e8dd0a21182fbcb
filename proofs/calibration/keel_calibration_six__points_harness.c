// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_six sides_fit scale_of model_calibration_six scale_on lies_in
//
// Chosen sides, each in a case of its own: the same as the model's, with all checks. Wrong bodies
// are refuted here, for where floats differ z3 finds no example.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

void keel_calibration_six__points_harness(void)
{
    for (unsigned point = 0u; point < SIDES_POINTS; point++) {
        const keel_calibration_sides_t sides = sides_point(point);
        keel_calibration_correction_t correction = {{7.0f, 7.0f, 7.0f}, {2.0f, 2.0f, 2.0f}};
        keel_calibration_correction_t model = correction;
        const keel_status_t status = keel_calibration_six(&sides, &correction);

        __CPROVER_assert(status == model_calibration_six(&sides, &model),
                         "CAL_017_exact: taken or refused as the model says");
        __CPROVER_assert(correction_same(&correction, &model),
                         "CAL_017_points: every field is what the model says");
    }
}
