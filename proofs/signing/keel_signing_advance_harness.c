// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_advance model_signing_advance
#include "signing_proof.h"

void keel_signing_advance_harness(void)
{
    const uint32_t at = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;
    const uint64_t timestamp = nondet_u64();

    model_signing_advance(&model, timestamp);

    keel_signing_advance(&signing, timestamp);

    __CPROVER_assert(signing_same(&signing, &model, at),
                     "SGN_003_model: every field is what the model says");
}
