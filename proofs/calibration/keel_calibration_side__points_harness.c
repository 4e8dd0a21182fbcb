// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_side way_of model_calibration_side lies_in
//
// Chosen means, each side once and what has none: the same as the model's, with all checks. Wrong
// bodies are refuted here.
#include "../../specs/model/calibration.h"
#include "calibration_points.h"

void keel_calibration_side__points_harness(void)
{
    for (unsigned point = 0u; point < MEAN_POINTS; point++) {
        const keel_calibration_vector_t mean = mean_point(point);

        __CPROVER_assert(keel_calibration_side(mean.axis, 6.0f, 1.0f) ==
                             model_calibration_side(mean.axis, 6.0f, 1.0f),
                         "CAL_016_points: the side is what the model says");
    }
}
