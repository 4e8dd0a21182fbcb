// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_advance model_signing_advance
#include "signing_proof.h"

void keel_signing_advance_harness(void)
{
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;
    const uint64_t timestamp = nondet_u64();

    model_signing_advance(&model, timestamp);

    keel_signing_advance(&signing, timestamp);

    for (uint32_t i = 0u; i < KEEL_SIGNING_TEXT_MAX; i++) {
        __CPROVER_assert(signing_same(&signing, &model, i),
                         "SGN_003_model: every field is what the model says");
    }
}
