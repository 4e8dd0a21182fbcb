// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_six model_calibration_six
//
// Any sides at all: result and every field are what the model says, bit for bit. All that it calls
// is reached in keel_calibration_six__points_harness.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_six_harness(void)
{
    keel_calibration_sides_t sides = nondet_sides();
    const keel_calibration_sides_t sides_before = sides;
    keel_calibration_correction_t correction = nondet_correction();
    keel_calibration_correction_t model = correction;
    const keel_status_t status = keel_calibration_six(&sides, &correction);

    __CPROVER_assert(status == model_calibration_six(&sides_before, &model),
                     "CAL_017_result: taken or refused as the model says");
    __CPROVER_assert(correction_same(&correction, &model),
                     "CAL_017_model: every field is what the model says");
    __CPROVER_assert(three_same(sides.up, sides_before.up) &&
                         three_same(sides.down, sides_before.down) &&
                         float_same(sides.gravity, sides_before.gravity) &&
                         float_same(sides.limit, sides_before.limit),
                     "CAL_017_frame: nothing else is written");
}
