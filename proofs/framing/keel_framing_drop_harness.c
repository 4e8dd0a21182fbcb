// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --unwindset keel_framing_drop.0:9,keel_framing_drop.1:9
// cbmc: --external-sat-solver cadical
// sources: src/middleware/framing.c specs/model/framing.c specs/model/framing_parts.c
// covers: keel_framing_drop is_header model_framing_drop model_framing_header
//
// Up to 8 bytes that are held, any of them dropped; each byte that is left. For as many as can be
// held, WP proves which are left (FRG_006_first, FRG_006_shifted).
#include "../../specs/model/framing.h"
#include "../common/framing_contracts.h"

void keel_framing_drop_harness(void)
{
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);
    keel_framing_t framing = nondet_framing();
    keel_framing_t model = framing;
    const keel_framing_t before = framing;
    const uint32_t count = nondet_u32();
    const uint32_t place = nondet_u32();

    __CPROVER_assume(keel_framing_drop_may(&framing, count) && (framing.held <= 8u));
    model_framing_drop(&model, count);

    keel_framing_drop(&framing, count);

    __CPROVER_assert(framing_same(&framing, &model, at),
                     "FRG_006_model: every field is what the model says");
    __CPROVER_assert(keel_framing_drop_does(&framing, before.held, count),
                     "FRG_006_valid: what is left begins with a header");
    __CPROVER_assert((place >= KEEL_FRAMING_BYTES) ||
                         framing_left_at(&framing, &before, count, place),
                     "FRG_006_left: and is what was behind, none of it lost but what is no header");
}
