// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_turn row_product model_calibration_turn
//
// Any bit pattern: the same as the model's, bit for bit.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_turn_harness(void)
{
    keel_calibration_rotation_t turn = nondet_turn();
    keel_calibration_vector_t raw = nondet_vector();
    const keel_calibration_rotation_t turn_before = turn;
    const keel_calibration_vector_t raw_before = raw;
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_turn(&turn, raw.axis, &out);
    model_calibration_turn(&turn_before, raw_before.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_018_model: what the model says");
    __CPROVER_assert(vector_same(&raw, &raw_before) && three_same(turn.x, turn_before.x) &&
                         three_same(turn.y, turn_before.y) && three_same(turn.z, turn_before.z),
                     "CAL_018_frame: nothing else is written");
}
