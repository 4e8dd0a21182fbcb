// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_set_key model_signing_set_key
#include "signing_proof.h"

void keel_signing_set_key_harness(void)
{
    const uint32_t at = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_valid_signing();
    keel_signing_t model = signing;
    uint8_t key[KEEL_SIGNING_KEY_BYTES];

    for (uint32_t i = 0u; i < KEEL_SIGNING_KEY_BYTES; i++) {
        key[i] = nondet_u8();
    }
    model_signing_set_key(&model, key);

    keel_signing_set_key(&signing, key);

    __CPROVER_assert(signing_same(&signing, &model, at),
                     "SGN_002_model: every field is what the model says");
}
