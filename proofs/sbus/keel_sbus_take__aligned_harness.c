// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_take keel_sbus_pass_time search_header
//
// Any right frame, none of whose bytes comes after a gap, whatever came before it: as long as no
// frame was taken since its first byte came, what is held ends with the bytes of it that came, and
// its last byte takes it. With no byte of it there is nothing to show, so by induction over its 25
// bytes every right frame is taken by its last byte, unless some of its bytes were taken already,
// as the end of another.
#include "sbus_proof.h"

void keel_sbus_take__aligned_harness(void)
{
    keel_sbus_t sbus = any_sbus();
    uint8_t frame[KEEL_SBUS_BYTES];
    const uint32_t count = nondet_u32();
    const uint32_t elapsed_us = nondet_u32();
    bool premise;
    bool right;

    __CPROVER_assume(sbus_valid_here(&sbus) && (count < 25u));
    any_bytes(frame);
    premise = model_sbus_right(frame, &sbus.config) && holds_last(&sbus, frame, count) &&
              (((uint64_t)sbus.quiet_us + elapsed_us) <= sbus.config.gap_us);

    right = keel_sbus_take(&sbus, frame[count], elapsed_us);

    if (count < 24u) {
        __CPROVER_assert(!premise || right || holds_last(&sbus, frame, count + 1u),
                         "RAD_011_step: what came of the frame is held");
    } else {
        __CPROVER_assert(!premise || (right && says(&sbus.frame, frame)),
                         "RAD_011_taken: its last byte takes it");
    }
}
