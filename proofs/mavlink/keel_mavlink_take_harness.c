// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282 --external-sat-solver cadical
// sources: src/middleware/mavlink.c specs/model/mavlink.c
// covers: keel_mavlink_take count_met model_mavlink_take tally
//
// Any valid decoder, any byte: the same as the model's in every field, and valid.
#include "../common/unchanged.h"
#include "mavlink_contracts.h"

void keel_mavlink_take_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_valid_mavlink();
    keel_mavlink_t model = mavlink;
    const keel_mavlink_t before = mavlink;
    const uint8_t byte = nondet_u8();
    const keel_status_t expected = model_mavlink_take(&model, byte);
    const keel_status_t status = keel_mavlink_take(&mavlink, byte);

    __CPROVER_assert(status == expected, "MAV_008_model: taken or refused as the model says");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_008_same: every field is what the model says");
    __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_003_valid: it stays valid");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&mavlink, &before, sizeof(mavlink)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
