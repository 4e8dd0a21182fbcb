// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_take keel_crsf_pass_time
//
// Any right frame. Its first bytes, none of them, or all and others behind are what is held; and a
// byte comes: if some of it are missing, the next of it, the first of all after a gap or not, the
// others without one. If that makes it whole, it is taken; else one more byte of it is held.
//
// So by induction over its bytes, a right frame is taken by its last byte when its first comes with
// nothing held, as it does after a gap. And one that comes to be first when what was before it is
// dropped is taken as soon as it is whole.
#include "crsf_proof.h"

void keel_crsf_take__first_harness(void)
{
    keel_crsf_t crsf = nondet_crsf();
    uint8_t frame[KEEL_FRAMING_BYTES];
    const uint32_t elapsed_us = nondet_u32();
    const bool late = framing_late_here(&crsf.framing, elapsed_us);
    const uint32_t held = late ? 0u : crsf.framing.held;
    keel_crsf_taken_t taken;
    uint32_t size;
    uint8_t byte;

    any_right_frame(frame);
    size = frame[1] + 2u;
    byte = (held < size) ? frame[held] : nondet_u8();
    __CPROVER_assume(crsf_valid_here(&crsf));
    __CPROVER_assume(framing_holds(&crsf.framing, frame, (held < size) ? held : size));

    taken = keel_crsf_take(&crsf, byte, elapsed_us);

    if ((held + 1u) >= size) {
        __CPROVER_assert((taken == kind_of(frame)) && says(&crsf, frame),
                         "CRF_010_taken: it is whole, and taken");
    } else {
        __CPROVER_assert((taken == KEEL_CRSF_NOTHING) && (crsf.framing.held == (held + 1u)) &&
                             framing_holds(&crsf.framing, frame, held + 1u),
                         "CRF_010_step: one more byte of it is held");
    }
}
