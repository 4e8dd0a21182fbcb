// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// sources: src/flight/attitude.c specs/model/attitude.c
// covers: keel_attitude_restart model_attitude_restart
//
// Any estimator at all: every field is what the model says, bit for bit.
#include "../../specs/model/attitude.h"
#include "attitude_proof.h"

void keel_attitude_restart_harness(void)
{
    keel_attitude_t attitude = any_attitude_at_all();
    keel_attitude_t model = attitude;

    keel_attitude_restart(&attitude);
    model_attitude_restart(&model);

    __CPROVER_assert(attitude_same(&attitude, &model),
                     "ATT_003_model: every field is what the model says");
}
