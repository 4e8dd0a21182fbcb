// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/position.c src/flight/axis.c specs/model/position.c specs/model/axis.c
// covers: keel_position_set_origin cosine_of model_position_set_origin cosine_by_series
//
// Any estimator at all, any latitude and longitude: the same as the model's, bit for bit. The
// solver sees that both compute the same only where nothing else is asked: the rest is in
// keel_position_set_origin__valid_harness.
#include "../../specs/model/position.h"
#include "position_proof.h"

void keel_position_set_origin_harness(void)
{
    const int32_t latitude = nondet_s32();
    const int32_t longitude = nondet_s32();
    keel_position_t position = any_position_at_all();
    keel_position_t model = position;
    const keel_status_t status = keel_position_set_origin(&position, latitude, longitude);

    __CPROVER_assert(status == model_position_set_origin(&model, latitude, longitude),
                     "POS_003_model: taken or refused as the model says");
    __CPROVER_assert(position_same(&position, &model),
                     "POS_004_model: every field is what the model says");
}
