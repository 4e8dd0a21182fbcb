// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 28 --external-sat-solver cadical
// cbmc: --unwindset place_of.0:257,find.0:257,publish_payload.0:256
// cbmc: --unwindset model_mavlink_frame.0:256,go_on.0:281
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// replaces: keel_crc16
// covers: keel_mavlink_look count_met id_in checksum_in end_of whole_frame place_of checksum_of
// covers: drop read_header timestamp_in publish_payload publish_signature publish_frame end_frame
// covers: model_mavlink_look tally go_on find may_be is_taken number
// covers: model_mavlink_whole model_mavlink_frame model_mavlink_checksum
//
// Any valid decoder of any table, that holds up to 26 bytes: the same as the model's in every
// field, and valid. WP shows the clauses for as many as can be held. What a byte makes of a
// checksum is unknown, the same for code and model.
#include "mavlink_proof.h"

#define HELD  26u
#define ASKED (HELD - 11u)
#include "told_crc.h"

void keel_mavlink_look_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    keel_mavlink_look_t expected;
    keel_mavlink_look_t seen;

    __CPROVER_assume(mavlink.held <= HELD);
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
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_valid: it stays valid");
}
