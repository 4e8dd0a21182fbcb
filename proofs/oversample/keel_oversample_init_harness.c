// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/oversample.c specs/model/oversample.c specs/model/range.c
// covers: keel_oversample_init begin model_oversample_init
#include "oversample_proof.h"

void keel_oversample_init_harness(void)
{
    keel_oversample_t o = any_oversample();
    keel_oversample_t model = o;
    const uint16_t factor = nondet_u16();
    const keel_status_t expected = model_oversample_init(&model, factor);
    const keel_status_t status = keel_oversample_init(&o, factor);

    __CPROVER_assert(status == expected, "OVS_001_model: as the model says");
    __CPROVER_assert(oversample_same(&o, &model), "OVS_001_model: in every field");
    __CPROVER_assert((status != KEEL_OK) || valid_here(&o), "OVS_001_ready: it is valid");
}
