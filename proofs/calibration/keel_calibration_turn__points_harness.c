// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 8 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_turn row_product model_calibration_turn
//
// A chosen turn: the same as the model's, with all checks. Wrong bodies are refuted here.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_turn__points_harness(void)
{
    const keel_calibration_rotation_t turn = {
        .x = {0.5f, 2.0f, -1.0f}, .y = {4.0f, -0.25f, 8.0f}, .z = {-16.0f, 3.0f, 0.125f}};
    const keel_calibration_vector_t raw = {{1.0f, 3.0f, 5.0f}};
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_turn(&turn, raw.axis, &out);
    model_calibration_turn(&turn, raw.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_018_points: what the model says");
}
