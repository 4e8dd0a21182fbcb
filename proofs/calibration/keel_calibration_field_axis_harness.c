// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_axis middle_of model_calibration_field_axis centre lies_in
//
// Any calibration at all: each axis is what the model says, and what its span says.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_field_axis_harness(void)
{
    const keel_calibration_field_t field = any_field_at_all();
    keel_calibration_field_t same = field;
    const uint32_t axis = any_axis();
    keel_calibration_verdict_t verdict;
    float span;

    __CPROVER_assume(field_finite(&field.config));

    verdict = keel_calibration_field_axis(&same, axis);
    span = field.highest[axis] - field.lowest[axis];

    __CPROVER_assert(verdict == model_calibration_field_axis(&field, axis),
                     "CAL_011_model: the result is what the model says");
    __CPROVER_assert(field_same(&same, &field), "CAL_011_frame: nothing is written");
    __CPROVER_assert((verdict == KEEL_CALIBRATION_NARROW) == !(span >= field.config.span_min),
                     "CAL_011_narrow: what was not turned enough");
    __CPROVER_assert((verdict != KEEL_CALIBRATION_WIDE) || (span > field.config.span_max),
                     "CAL_011_wide: what saw more than there is");
    __CPROVER_assert((verdict != KEEL_CALIBRATION_FIT) ||
                         within(span, field.config.span_min, field.config.span_max),
                     "CAL_011_fit: what fits has the span");
}
