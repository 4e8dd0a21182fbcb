// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_begin set_axes model_calibration_rest_begin
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
    __CPROVER_assert((rest.state == KEEL_CALIBRATION_COLLECTING) && (rest.count == 0u) &&
                         (rest.restarts == 0u) && (rest.beyond == 0u),
                     "CAL_003_begun: samples are looked at");
    __CPROVER_assert(three_within(rest.first, 0.0f, 0.0f) && three_within(rest.sum, 0.0f, 0.0f),
                     "CAL_003_zero: as if none had come");
    __CPROVER_assert(!valid || rest_valid(&rest), "CAL_013_begun: it stays valid");
}
