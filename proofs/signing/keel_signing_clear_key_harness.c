// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_clear_key model_signing_clear_key
#include "signing_proof.h"

void keel_signing_clear_key_harness(void)
{
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;

    model_signing_clear_key(&model);

    keel_signing_clear_key(&signing);

    for (uint32_t i = 0u; i < KEEL_SIGNING_TEXT_MAX; i++) {
        __CPROVER_assert(signing_same(&signing, &model, i),
                         "SGN_002_forgotten: every field is what the model says");
    }
}
