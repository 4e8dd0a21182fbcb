// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_apply model_calibration_apply
//
// Any bit pattern, written beside or over what was measured: the same as the model's, bit for bit.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_apply_harness(void)
{
    three_t offset = nondet_three();
    three_t raw = nondet_three();
    const three_t offset_before = offset;
    const three_t raw_before = raw;
    three_t apart = nondet_three();
    three_t model = apart;
    const bool is_over = nondet_bool();
    float *const out = is_over ? raw.axis : apart.axis;

    keel_calibration_apply(offset.axis, raw.axis, out);
    model_calibration_apply(offset_before.axis, raw_before.axis, model.axis);

    __CPROVER_assert(three_same(out, model.axis), "CAL_014_model: what the model says");
    __CPROVER_assert((is_over || three_same(raw.axis, raw_before.axis)) &&
                         three_same(offset.axis, offset_before.axis),
                     "CAL_014_frame: nothing else is written");
}
