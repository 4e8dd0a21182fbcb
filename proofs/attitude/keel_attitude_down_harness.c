// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_down axes_of model_attitude_down down_of
//
// Any quaternion at all: the same as the model's, bit for bit.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

void keel_attitude_down_harness(void)
{
    keel_attitude_t attitude = any_attitude_at_all();
    const keel_attitude_t before = attitude;
    const keel_attitude_vector_t down = keel_attitude_down(&attitude);
    const keel_attitude_vector_t model = model_attitude_down(&before);

    __CPROVER_assert(vector_same(&down, &model),
                     "ATT_019_model: the direction is what the model says");
    __CPROVER_assert(attitude_same(&attitude, &before),
                     "ATT_019_frame: the estimator is not written");
}
