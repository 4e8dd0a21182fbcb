// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_clear_key model_signing_clear_key
#include "signing_proof.h"

void keel_signing_clear_key_harness(void)
{
    const uint32_t at = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;

    model_signing_clear_key(&model);

    keel_signing_clear_key(&signing);

    __CPROVER_assert(signing_same(&signing, &model, at),
                     "SGN_002_forgotten: every field is what the model says");
}
