// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282 --external-sat-solver cadical
// sources: src/middleware/mavlink.c specs/model/mavlink_gap.c
// replaces: keel_mavlink_look keel_mavlink_drop
// covers: keel_mavlink_gap model_mavlink_gap
//
// Any valid decoder of any table, when no byte follows: the same as the model's in every field, and
// valid. What a look finds, and what is left when bytes are dropped, are unknown, the same for code
// and model.
#include "mavlink_contracts.h"

#include "told_drop.h"
#include "told_look.h"

void keel_mavlink_gap_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    keel_mavlink_look_t expected;
    keel_mavlink_look_t seen;

    expected = model_mavlink_gap(&model);

    seen = keel_mavlink_gap(&mavlink);

    __CPROVER_assert(seen == expected, "MAV_010_found: it finds what the model finds");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_010_model: every field is what the model says");
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_valid: it stays valid");
}
