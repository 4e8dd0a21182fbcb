// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282 --external-sat-solver cadical
// cbmc: --unwindset place_of.0:6,find.0:6,checksum_of.0:43,model_mavlink_checksum.0:43
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// replaces: keel_crc16 keel_mavlink_drop
// covers: keel_mavlink_look count_met id_in checksum_in end_of whole_frame place_of checksum_of
// covers: read_header timestamp_in publish_payload publish_signature publish_frame end_frame
// covers: model_mavlink_look tally find may_be is_taken number
// covers: model_mavlink_whole model_mavlink_frame model_mavlink_checksum
//
// Any valid decoder of a table of up to 4 messages that awaits a header, or a frame with a payload
// of up to 32 bytes: the same as the model's in every field, and valid. WP shows which message is
// found in any table, and of any frame whether it is right and what it says, but for its signature.
// What a byte makes of a checksum, and what is left when bytes are dropped, are unknown, the same
// for code and model.
#include "mavlink_contracts.h"

#define ASKED 42u
#include "told_crc.h"
#include "told_drop.h"

void keel_mavlink_look_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    keel_mavlink_look_t expected;
    keel_mavlink_look_t seen;

    __CPROVER_assume(keel_mavlink_look_may(&mavlink) && (mavlink.known <= 4u));
    __CPROVER_assume((mavlink.awaited == 10u) || (mavlink.bytes[1] <= 32u));
    tell_model();
    expected = model_mavlink_look(&model);

    tell_code();
    seen = keel_mavlink_look(&mavlink);

    __CPROVER_assert(seen == expected, "MAV_004_model: it finds what the model finds");
    __CPROVER_assert(mavlink_frame_same(&mavlink.frame, &model.frame, (at < 255u) ? at : 0u),
                     "MAV_005_model: it says what the model says");
    __CPROVER_assert(mavlink_count_same(&mavlink.count, &model.count),
                     "MAV_007_model: what is counted is what the model counts");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_003_model: every field is what the model says");
    __CPROVER_assert(keel_mavlink_look_does(&mavlink), "MAV_003_valid: it stays valid");
}
