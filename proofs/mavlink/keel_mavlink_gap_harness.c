// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 28 --external-sat-solver cadical
// cbmc: --unwindset place_of.0:257,find.0:257,publish_payload.0:256
// cbmc: --unwindset model_mavlink_frame.0:256,go_on.0:281
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// replaces: keel_crc16
// covers: keel_mavlink_gap model_mavlink_gap
//
// Any valid decoder of any table, that holds up to 26 bytes, when no byte follows: the same as the
// model's in every field, and valid. WP shows the clauses for as many as can be held. What a byte
// makes of a checksum is unknown, the same for code and model.
#include "mavlink_proof.h"

#define HELD  26u
#define ASKED (HELD - 11u)
#include "told_crc.h"

void keel_mavlink_gap_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    keel_mavlink_look_t expected;
    keel_mavlink_look_t seen;

    __CPROVER_assume(mavlink.held <= HELD);
    tell_model();
    expected = model_mavlink_gap(&model);

    tell_code();
    seen = keel_mavlink_gap(&mavlink);

    __CPROVER_assert(seen == expected, "MAV_010_found: it finds what the model finds");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_010_model: every field is what the model says");
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_valid: it stays valid");
}
