// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_begin set_all model_calibration_rest_begin
//
// Any calibration at all: the same as the model's, bit for bit; a valid one stays valid.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_rest_begin_harness(void)
{
    keel_calibration_rest_t rest = any_rest_at_all();
    keel_calibration_rest_t model = rest;
    const bool valid = rest_valid(&rest);

    keel_calibration_rest_begin(&rest);
    model_calibration_rest_begin(&model);

    __CPROVER_assert(rest_same(&rest, &model), "CAL_003_model: every field is what the model says");
    __CPROVER_assert(!valid || rest_valid(&rest), "CAL_003_valid: it stays valid");
}
