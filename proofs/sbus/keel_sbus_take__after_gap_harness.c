// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_take keel_sbus_pass_time
//
// Any right frame of which count bytes have come since a gap, and no gap since: after the next byte
// it is as with one more, and the last one takes the frame. The first byte comes after a gap, or
// when nothing is held; so by induction over its 25 bytes a right frame after a gap is taken,
// whatever was before.
#include "sbus_proof.h"

void keel_sbus_take__after_gap_harness(void)
{
    keel_sbus_t sbus = any_sbus();
    uint8_t frame[KEEL_SBUS_BYTES];
    const uint32_t count = nondet_u32();
    const uint32_t elapsed_us = nondet_u32();
    uint64_t quiet_us;
    bool right;

    __CPROVER_assume(sbus_valid_here(&sbus) && sbus_config_valid(&sbus.config));
    __CPROVER_assume(count < 25u);
    any_right_frame(frame, &sbus.config);
    quiet_us = (uint64_t)sbus.quiet_us + elapsed_us;
    __CPROVER_assume(holds_just(&sbus, frame, count) ? (quiet_us <= sbus.config.gap_us)
                                                     : (count == 0u));
    __CPROVER_assume((sbus.held == count) ||
                     ((quiet_us > sbus.config.gap_us) && (sbus.config.gap_us < UINT32_MAX)));

    right = keel_sbus_take(&sbus, frame[count], elapsed_us);

    if (count < 24u) {
        __CPROVER_assert(!right && holds_just(&sbus, frame, count + 1u),
                         "RAD_009_step: one more byte of the frame is held");
    } else {
        __CPROVER_assert(right && says(&sbus.frame, frame), "RAD_009_taken: the last one takes it");
    }
}
