// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// checks: assertions
// sources: src/flight/calibration.c specs/model/calibration.c
// covers: keel_calibration_rest_init rest_limits_fit are_within set_axes
// covers: keel_calibration_rest_begin model_calibration_rest_init model_calibration_rest_begin
// covers: all_lie_in lies_in
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_calibration_rest_init__valid_harness and keel_calibration_rest_init__exact_harness.
#include "../../specs/model/calibration.h"
#include "calibration_proof.h"

void keel_calibration_rest_init_harness(void)
{
    keel_calibration_rest_config_t config = nondet_rest_config();
    const keel_calibration_rest_config_t before = config;
    keel_calibration_rest_t rest = any_rest_at_all();
    keel_calibration_rest_t model = rest;
    const keel_status_t status = keel_calibration_rest_init(&rest, &config);

    __CPROVER_assert(status == model_calibration_rest_init(&model, &before),
                     "CAL_001_model: taken or refused as the model says");
    __CPROVER_assert(rest_same(&rest, &model), "CAL_002_model: every field is what the model says");
    __CPROVER_assert(rest_config_same(&config, &before),
                     "CAL_002_frame: the configuration is not written");
}
