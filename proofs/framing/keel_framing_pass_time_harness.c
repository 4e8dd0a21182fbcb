// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/framing.c specs/model/framing.c
// covers: keel_framing_pass_time keel_framing_sum model_framing_pass_time model_framing_sum
#include "../../specs/model/framing.h"
#include "../common/framing_contracts.h"

void keel_framing_pass_time_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_framing_t framing = nondet_framing();
    keel_framing_t model = framing;
    const uint32_t elapsed_us = nondet_u32();

    model_framing_pass_time(&model, elapsed_us);

    keel_framing_pass_time(&framing, elapsed_us);

    __CPROVER_assert(framing_same(&framing, &model, at),
                     "FRG_003_model: every field is what the model says");
}
