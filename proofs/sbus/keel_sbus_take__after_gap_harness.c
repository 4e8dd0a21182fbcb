// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_take keel_sbus_pass_time
//
// Any right frame: its first byte comes after a gap, or when nothing is held; the others come
// without one, when all that is held are those before. After each there is one more of them, and
// the last takes the frame. So by induction over its 25 bytes a right frame after a gap is taken by
// its last byte, whatever was before.
#include "sbus_proof.h"

void keel_sbus_take__after_gap_harness(void)
{
    keel_sbus_t sbus = any_sbus();
    uint8_t frame[KEEL_SBUS_BYTES];
    const uint32_t count = nondet_u32();
    const uint32_t elapsed_us = nondet_u32();
    bool premise;
    bool gap;
    bool right;

    __CPROVER_assume(sbus_valid_here(&sbus) && (count < 25u));
    any_bytes(frame);
    gap = (sbus.quiet_us > sbus.config.gap_us) ||
          ((sbus.config.gap_us < UINT32_MAX) &&
           (elapsed_us > (sbus.config.gap_us - sbus.quiet_us)));
    premise = model_sbus_right(frame, &sbus.config) &&
              (gap ? (count == 0u) : holds_just(&sbus, frame, count));

    right = keel_sbus_take(&sbus, frame[count], elapsed_us);

    if (count < 24u) {
        __CPROVER_assert(!premise || (!right && holds_just(&sbus, frame, count + 1u)),
                         "RAD_009_step: one more byte of the frame is held");
    } else {
        __CPROVER_assert(!premise || (right && says(&sbus.frame, frame)),
                         "RAD_009_taken: the last one takes it");
    }
}
