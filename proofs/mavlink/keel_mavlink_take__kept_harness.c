// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 256 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// covers: keel_mavlink_take offer hold count_met pair_at end_of whole_frame place_of check_flags
// covers: check_message timestamp_at publish_payload publish_signature publish_frame end_frame
//
// The clauses, without the model: what is published was right as a whole, and nothing else is.
#include "mavlink_proof.h"

void keel_mavlink_take__kept_harness(void)
{
    keel_mavlink_t mavlink = any_valid_mavlink();
    const keel_mavlink_t before = mavlink;
    const uint8_t byte = nondet_u8();
    const uint32_t i = nondet_u32();
    const bool right = keel_mavlink_take(&mavlink, byte);

    __CPROVER_assert((mavlink.messages == before.messages) && (mavlink.known == before.known),
                     "MAV_006_table: the messages that are known stay");
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_stays: it stays valid");
    if (right) {
        const uint32_t end = 10u + (uint32_t)mavlink.bytes[1];

        __CPROVER_assume(i < before.held);
        __CPROVER_assert((mavlink.bytes[i] == before.bytes[i]) &&
                             (byte == mavlink.bytes[before.held]),
                         "MAV_004_came: these bytes came, one behind the other");
        __CPROVER_assert((mavlink.bytes[0] == 0xFDu) && (mavlink.bytes[2] <= 1u) &&
                             ((before.held + 1u) == model_mavlink_whole(mavlink.bytes)),
                         "MAV_004_all: they are all of a frame");
        __CPROVER_assert((mavlink.message < MESSAGES) &&
                             is_of(mavlink.bytes, &table[mavlink.message]),
                         "MAV_004_known: its message is known, and may be so long");
        __CPROVER_assert((mavlink.bytes[end] + (256u * mavlink.bytes[end + 1u])) ==
                             keel_crc16(before.crc, table[mavlink.message].crc_extra),
                         "MAV_004_right: its checksum is right");
        __CPROVER_assert(mavlink.held == 0u, "MAV_008_gone: nothing of it is held");
    } else {
        __CPROVER_assert(mavlink_frame_same(&mavlink.frame, &before.frame),
                         "MAV_006_kept: without a right frame the last one stays");
        __CPROVER_assert(mavlink.count.frames == before.count.frames,
                         "MAV_007_none: none is counted");
    }
}
