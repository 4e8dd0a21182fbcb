// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 307 --external-sat-solver cadical
// sources: src/middleware/signing.c specs/model/signing.c
// covers: keel_signing_init model_signing_init
#include "signing_proof.h"

#include <stddef.h>

void keel_signing_init_harness(void)
{
    const uint32_t at = any_below(KEEL_SIGNING_TEXT_MAX);
    keel_signing_t signing = any_signing();
    keel_signing_t model;
    const uint8_t link = nondet_u8();

    signing.hash = nondet_bool() ? any_hash : NULL; // What was there is not what it gets.
    model = signing;
    model_signing_init(&model, link, any_hash);

    keel_signing_init(&signing, link, any_hash);

    __CPROVER_assert(signing_same(&signing, &model, at),
                     "SGN_001_model: every field is what the model says");
}
