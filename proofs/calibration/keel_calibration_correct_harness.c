// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_correct model_calibration_correct
//
// Any bit pattern: the same as the model's, bit for bit.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_correct_harness(void)
{
    keel_calibration_correction_t correction = nondet_correction();
    keel_calibration_vector_t raw = nondet_vector();
    const keel_calibration_correction_t correction_before = correction;
    const keel_calibration_vector_t raw_before = raw;
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_correct(&correction, raw.axis, &out);
    model_calibration_correct(&correction_before, raw_before.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_015_model: what the model says");
    __CPROVER_assert(vector_same(&raw, &raw_before) &&
                         correction_same(&correction, &correction_before),
                     "CAL_015_frame: nothing else is written");
}
