// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_field_finish model_calibration_field_finish
//
// Any calibration at all: result and every field are what the model says, bit for bit. All that
// finish calls is reached in keel_calibration_field_finish__valid_harness.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_field_finish_harness(void)
{
    keel_calibration_field_t field = any_field_at_all();
    keel_calibration_field_t model = field;
    const keel_status_t status = keel_calibration_field_finish(&field);

    __CPROVER_assert(status == model_calibration_field_finish(&model),
                     "CAL_012_result: taken or refused as the model says");
    __CPROVER_assert(field_same(&field, &model),
                     "CAL_012_model: every field is what the model says");
}
