// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 281 --unwindset is_table.0:5,in_order.0:5 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_init is_table model_mavlink_init in_order
//
// Any table of 3 messages, and a number of them that is too large. WP shows the clauses for any
// number.
#include "../common/unchanged.h"
#include "mavlink_proof.h"

void keel_mavlink_init_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    keel_mavlink_t mavlink = any_mavlink();
    keel_mavlink_t model = mavlink;
    const keel_mavlink_t before = mavlink;
    const uint32_t known = nondet_bool() ? KEEL_MAVLINK_MESSAGES_MAX + 1 : MESSAGES;
    keel_status_t expected;
    keel_status_t status;

    expected = model_mavlink_init(&model, table, known);

    status = keel_mavlink_init(&mavlink, table, known);

    __CPROVER_assert(status == expected, "MAV_001_model: taken or refused as the model says");
    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_002_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) == ((known == MESSAGES) && table_in_order(MESSAGES)),
                     "MAV_001_taken: all that is in order is taken");
    if (status == KEEL_OK) {
        __CPROVER_assert(mavlink_valid_here(&mavlink), "MAV_002_valid: what is made is valid");
    } else {
        __CPROVER_assert(unchanged(&mavlink, &before, sizeof(mavlink)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
