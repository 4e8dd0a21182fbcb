// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/oversample.c specs/model/range.c
// covers: keel_oversample_add model_oversample_add
#include "oversample_proof.h"

void keel_oversample_add_harness(void)
{
    keel_oversample_t o = any_oversample();
    keel_oversample_t model = o;
    const float value = nondet_float();
    keel_status_t expected;
    keel_status_t status;

    __CPROVER_assume(valid_here(&o));
    expected = model_oversample_add(&model, value);

    status = keel_oversample_add(&o, value);

    __CPROVER_assert(status == expected, "OVS_002_model: as the model says");
    __CPROVER_assert(oversample_same(&o, &model), "OVS_002_model: in every field");
    __CPROVER_assert(valid_here(&o), "OVS_002_valid: it stays valid");
}
