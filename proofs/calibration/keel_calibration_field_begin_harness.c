// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_begin set_axes model_calibration_field_begin
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
    __CPROVER_assert((field.state == KEEL_CALIBRATION_COLLECTING) && (field.dropped == 0u),
                     "CAL_009_begun: samples are looked at");
    __CPROVER_assert(!field_finite(&field.config) ||
                         three_within(field.lowest, field.config.highest, field.config.highest),
                     "CAL_009_lowest: none was low");
    __CPROVER_assert(!field_finite(&field.config) ||
                         three_within(field.highest, field.config.lowest, field.config.lowest),
                     "CAL_009_highest: none was high");
    __CPROVER_assert(!valid || field_valid(&field), "CAL_013_again: it stays valid");
}
