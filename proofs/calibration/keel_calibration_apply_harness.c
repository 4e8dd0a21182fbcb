// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_apply model_calibration_apply
//
// Any bit pattern: the same as the model's, bit for bit.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_apply_harness(void)
{
    keel_calibration_vector_t offset = nondet_vector();
    keel_calibration_vector_t raw = nondet_vector();
    const keel_calibration_vector_t offset_before = offset;
    const keel_calibration_vector_t raw_before = raw;
    keel_calibration_vector_t out = nondet_vector();
    keel_calibration_vector_t model = out;

    keel_calibration_apply(offset.axis, raw.axis, &out);
    model_calibration_apply(offset_before.axis, raw_before.axis, &model);

    __CPROVER_assert(vector_same(&out, &model), "CAL_014_model: what the model says");
    __CPROVER_assert(vector_same(&raw, &raw_before) && vector_same(&offset, &offset_before),
                     "CAL_014_frame: nothing else is written");
}
