// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_pass_time model_ibus_pass_time
#include "ibus_proof.h"

void keel_ibus_pass_time_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_ibus_t ibus = any_ibus();
    keel_ibus_t model = ibus;
    const uint32_t elapsed_us = nondet_u32();

    model_ibus_pass_time(&model, elapsed_us);

    keel_ibus_pass_time(&ibus, elapsed_us);

    __CPROVER_assert(ibus_same(&ibus, &model, at),
                     "IBU_008_model: every field is what the model says");
}
