// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/position.c src/flight/axis.c specs/model/position.c specs/model/axis.c
// covers: keel_position_init accuracies_fit model_position_init good_to
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: the rest is in
// keel_position_init__valid_harness.
#include "../../specs/model/position.h"
#include "position_proof.h"

void keel_position_init_harness(void)
{
    keel_position_config_t config = nondet_position_config();
    const keel_position_config_t before = config;
    keel_position_t position = any_position_at_all();
    keel_position_t model = position;
    const keel_status_t status = keel_position_init(&position, &config);

    __CPROVER_assert(status == model_position_init(&model, &before),
                     "POS_001_model: taken or refused as the model says");
    __CPROVER_assert(position_same(&position, &model),
                     "POS_002_model: every field is what the model says");
    __CPROVER_assert(position_config_same(&config, &before),
                     "POS_002_frame: the configuration is not written");
}
