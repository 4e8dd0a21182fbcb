// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_correct model_calibration_correct
//
// Any bit pattern, written over what was measured: the same as elsewhere.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_correct__over_harness(void)
{
    const keel_calibration_correction_t correction = nondet_correction();
    const keel_calibration_vector_t raw = nondet_vector();
    keel_calibration_vector_t out = raw;
    keel_calibration_vector_t model = nondet_vector();

    keel_calibration_correct(&correction, out.axis, &out);
    model_calibration_correct(&correction, raw.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_015_over: in its own place, too");
}
