// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// sources: src/middleware/oversample.c specs/model/oversample.c specs/model/range.c
// checks: assertions
// covers: keel_oversample_take add_excess begin model_oversample_take
//
// All other checks: keel_oversample_take__valid_harness.c.
#include "oversample_proof.h"

void keel_oversample_take_harness(void)
{
    keel_oversample_t o = any_oversample();
    keel_oversample_t model = o;
    float mean = nondet_float();
    float model_mean = mean;
    keel_status_t expected;
    keel_status_t status;

    expected = model_oversample_take(&model, &model_mean);

    status = keel_oversample_take(&o, &mean);

    __CPROVER_assert(status == expected, "OVS_004_model: as the model says");
    __CPROVER_assert(float_same(mean, model_mean), "OVS_004_model: the mean");
    __CPROVER_assert(oversample_same(&o, &model), "OVS_005_model: in every field");
}
