// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 282 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_init is_table model_mavlink_init in_order
//
// Any table, and any number of messages, those that are too large included.
#include "../common/unchanged.h"
#include "mavlink_contracts.h"

void keel_mavlink_init_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    keel_mavlink_t mavlink = any_mavlink();
    keel_mavlink_t model = mavlink;
    const keel_mavlink_t before = mavlink;
    const uint32_t known = nondet_u32();
    keel_status_t expected;
    keel_status_t status;

    expected = model_mavlink_init(&model, table.messages, known);

    status = keel_mavlink_init(&mavlink, table.messages, known);

    __CPROVER_assert(status == expected, "MAV_001_model: taken or refused as the model says");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_002_model: every field is what the model says");
    if (status == KEEL_OK) {
        __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&mavlink, &before, sizeof(mavlink)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
