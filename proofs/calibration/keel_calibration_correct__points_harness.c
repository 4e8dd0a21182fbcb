// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_correct model_calibration_correct
//
// A chosen sample: the same as the model's, with all checks. Wrong bodies are refuted here.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_correct__points_harness(void)
{
    const keel_calibration_correction_t correction = {.offset = {1.0f, -2.0f, 3.0f},
                                                      .scale = {0.875f, 1.0f, 1.125f}};
    const keel_calibration_vector_t raw = {{9.0f, 20.0f, 43.0f}};
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_correct(&correction, raw.axis, &out);
    model_calibration_correct(&correction, raw.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_015_points: what the model says");
}
