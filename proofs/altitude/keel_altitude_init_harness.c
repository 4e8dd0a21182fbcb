// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/altitude.c src/flight/axis.c specs/model/altitude.c specs/model/axis.c
// covers: keel_altitude_init model_altitude_init
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: the rest is in
// keel_altitude_init__valid_harness.
#include "../../specs/model/altitude.h"
#include "altitude_proof.h"

void keel_altitude_init_harness(void)
{
    keel_axis_config_t config = nondet_axis_config();
    const keel_axis_config_t before = config;
    keel_altitude_t altitude = any_altitude_at_all();
    keel_altitude_t model = altitude;
    const keel_status_t status = keel_altitude_init(&altitude, &config);

    __CPROVER_assert(status == model_altitude_init(&model, &before),
                     "ALT_001_model: taken or refused as the model says");
    __CPROVER_assert(altitude_same(&altitude, &model),
                     "ALT_002_model: every field is what the model says");
    __CPROVER_assert(axis_config_same(&config, &before),
                     "ALT_002_frame: the configuration is not written");
}
