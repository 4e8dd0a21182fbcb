// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 26 --external-sat-solver cadical
// sources: src/middleware/sbus.c specs/model/sbus.c
// covers: keel_sbus_take keel_sbus_pass_time add_up_to_end count_to_end field_of is_footer
// covers: is_judged are_plausible publish search_header take_frame
//
// The clauses, without the model: what is published was right as a whole, and nothing else is.
#include "sbus_proof.h"

void keel_sbus_take__kept_harness(void)
{
    keel_sbus_t sbus = any_sbus();
    const keel_sbus_t before = sbus;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    bool right;

    __CPROVER_assume(sbus_valid_here(&sbus));

    right = keel_sbus_take(&sbus, byte, elapsed_us);

    __CPROVER_assert(sbus_config_same(&sbus.config, &before.config),
                     "RAD_006_config: the configuration stays");
    if (right) {
        __CPROVER_assert(holds_just(&before, sbus.buffer, 24u) && (byte == sbus.buffer[24]),
                         "RAD_010_whole: these 25 bytes came, one behind the other");
        __CPROVER_assert(model_sbus_right(sbus.buffer, &sbus.config),
                         "RAD_004_right: they are a right frame");
        __CPROVER_assert(says(&sbus.frame, sbus.buffer), "RAD_005_says: and this is what it says");
        __CPROVER_assert((sbus.age_us == 0u) && (sbus.held == 0u), "RAD_008_new: and it is new");
    } else {
        __CPROVER_assert(sbus_frame_same(&sbus.frame, &before.frame),
                         "RAD_006_kept: without a right frame the last one stays");
        __CPROVER_assert(sbus.count.frames == before.count.frames, "RAD_007_none: none is counted");
        __CPROVER_assert(sbus.age_us >= before.age_us, "RAD_008_older: and it is no newer");
    }
}
