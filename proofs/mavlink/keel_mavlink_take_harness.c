// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 256 --external-sat-solver cadical
// reach: --refine
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// replaces: keel_crc16
// covers: keel_mavlink_take offer put_byte count_met id_in checksum_in end_of whole_frame place_of
// covers: check_flags check_message timestamp_in publish_payload publish_signature publish_frame
// covers: end_frame
// covers: model_mavlink_take begin_with keep begin_again look_up finish_frame tally number
// covers: model_mavlink_whole model_mavlink_frame
//
// Any valid decoder of any 3 messages, any byte: the same as the model's in every field, and
// valid. WP shows the clauses for any number of messages. What a byte makes of a checksum is
// unknown, the same for code and model.
#include "mavlink_proof.h"
#include "unknown_crc.h"

void keel_mavlink_take_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    const uint8_t byte = nondet_u8();
    const bool expected = model_mavlink_take(&model, byte);
    const bool right = keel_mavlink_take(&mavlink, byte);

    __CPROVER_assert(right == expected, "MAV_004_model: a frame ends where the model says");
    __CPROVER_assert(mavlink_frame_same(&mavlink.frame, &model.frame, at),
                     "MAV_005_model: it says what the model says");
    __CPROVER_assert(mavlink_count_same(&mavlink.count, &model.count),
                     "MAV_007_model: what is counted is what the model counts");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_003_model: every field is what the model says");
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_valid: it stays valid");
}
