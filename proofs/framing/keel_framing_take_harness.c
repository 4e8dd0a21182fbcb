// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/framing.c specs/model/framing.c
// covers: keel_framing_take keel_framing_pass_time keel_framing_sum is_header
// covers: model_framing_take model_framing_sum model_framing_header hold
//
// Any valid state, any byte, any time.
#include "../../specs/model/framing.h"
#include "../common/framing_contracts.h"

void keel_framing_take_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_framing_t framing = nondet_framing();
    keel_framing_t model = framing;
    const keel_framing_t before = framing;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();

    __CPROVER_assume(framing_valid_here(&framing));
    model_framing_take(&model, byte, elapsed_us);

    keel_framing_take(&framing, byte, elapsed_us);

    __CPROVER_assert(framing_same(&framing, &model, at),
                     "FRG_005_model: every field is what the model says");
    __CPROVER_assert(framing_begins_here(&framing),
                     "FRG_005_begins: what is held begins with a header");
    __CPROVER_assert(!framing_late_here(&before, elapsed_us) || (framing.held <= 1u),
                     "FRG_004_late: a late byte leaves none before it");
}
