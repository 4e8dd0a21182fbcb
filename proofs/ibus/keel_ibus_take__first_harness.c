// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_take keel_ibus_pass_time
//
// Any right frame. Its first bytes, or none of them, are what is held, and the next of it comes;
// the first of all after a gap or not, the others without one. The last one takes it; after
// another, one more byte of it is held. So by induction over its bytes, a right frame is taken by
// its last byte when its first comes with nothing held, as it does after a gap; or when what was
// before it is dropped.
#include "ibus_proof.h"

static bool takes(bool right, const keel_ibus_t *ibus, const uint8_t *frame)
{
    return right && says(ibus, frame);
}

static bool holds_one_more(bool right, const keel_ibus_t *ibus, const uint8_t *frame, uint32_t held)
{
    return !right && (ibus->framing.held == (held + 1u)) &&
           framing_holds(&ibus->framing, frame, held + 1u);
}

void keel_ibus_take__first_harness(void)
{
    keel_ibus_t ibus = any_ibus();
    uint8_t frame[KEEL_FRAMING_BYTES];
    const uint32_t elapsed_us = nondet_u32();
    const bool late = framing_late_here(&ibus.framing, elapsed_us);
    const uint32_t held = late ? 0u : ibus.framing.held;
    bool right;

    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        frame[i] = nondet_u8();
    }
    __CPROVER_assume(ibus_valid_here(&ibus) && model_ibus_right(frame, &ibus.config));
    __CPROVER_assume(framing_holds(&ibus.framing, frame, held));

    right = keel_ibus_take(&ibus, frame[held], elapsed_us);

    if (held == 31u) {
        __CPROVER_assert(takes(right, &ibus, frame), "IBU_009_taken: it is whole, and taken");
    } else {
        __CPROVER_assert(holds_one_more(right, &ibus, frame, held),
                         "IBU_009_step: one more byte of it is held");
    }
}
