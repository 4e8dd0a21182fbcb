// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_apply model_calibration_apply
//
// A chosen sample: the same as the model's. All of them are dealt with in
// keel_calibration_apply_harness; wrong bodies are refuted here.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_apply__points_harness(void)
{
    const keel_calibration_vector_t offset = {{1.0f, -2.0f, 3.0f}};
    const keel_calibration_vector_t raw = {{10.0f, 20.0f, 40.0f}};
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_apply(offset.axis, raw.axis, &out);
    model_calibration_apply(offset.axis, raw.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_014_points: what the model says");
}
