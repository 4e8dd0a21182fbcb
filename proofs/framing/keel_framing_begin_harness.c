// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/framing.c specs/model/framing.c
// covers: keel_framing_begin model_framing_begin
#include "../../specs/model/framing.h"
#include "../common/framing_contracts.h"

void keel_framing_begin_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_framing_t framing = nondet_framing();
    keel_framing_t model = framing;
    const uint32_t gap_us = nondet_u32();
    const uint8_t header[KEEL_FRAMING_HEADERS] = {nondet_u8(), nondet_u8(), nondet_u8(),
                                                  nondet_u8()};

    model_framing_begin(&model, gap_us, header);

    keel_framing_begin(&framing, gap_us, header);

    __CPROVER_assert(framing_same(&framing, &model, at),
                     "FRG_002_model: every field is what the model says");
    __CPROVER_assert(framing_valid_here(&framing), "FRG_002_valid: what is begun is valid");
}
