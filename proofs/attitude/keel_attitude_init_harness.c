// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_init attitude_gains_fit attitude_limits_fit is_field set_scale
// covers: model_attitude_init gains_valid limits_valid field_valid
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_attitude_init__valid_harness.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

void keel_attitude_init_harness(void)
{
    keel_attitude_config_t config = nondet_attitude_config();
    const keel_attitude_config_t before = config;
    keel_attitude_t attitude = any_attitude_at_all();
    keel_attitude_t model = attitude;
    const keel_status_t status = keel_attitude_init(&attitude, &config);

    __CPROVER_assert(status == model_attitude_init(&model, &before),
                     "ATT_001_model: taken or refused as the model says");
    __CPROVER_assert(attitude_same(&attitude, &model),
                     "ATT_002_model: every field is what the model says");
    __CPROVER_assert(attitude_config_same(&config, &before),
                     "ATT_002_frame: the configuration is not written");
}
