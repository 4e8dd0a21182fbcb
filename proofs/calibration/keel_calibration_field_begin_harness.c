// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_begin set_all model_calibration_field_begin
//
// Any calibration at all: the same as the model's, bit for bit; a valid one stays valid.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_field_begin_harness(void)
{
    keel_calibration_field_t field = any_field_at_all();
    keel_calibration_field_t model = field;
    const bool valid = field_valid(&field);

    keel_calibration_field_begin(&field);
    model_calibration_field_begin(&model);

    __CPROVER_assert(field_same(&field, &model),
                     "CAL_009_model: every field is what the model says");
    __CPROVER_assert(!valid || field_valid(&field), "CAL_009_valid: it stays valid");
}
