// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 256 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c specs/model/crc.c
// covers: keel_mavlink_gap count_met model_mavlink_gap tally
#include "mavlink_proof.h"

void keel_mavlink_gap_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_PAYLOAD_MAX);
    keel_mavlink_t mavlink = any_mavlink();
    keel_mavlink_t model = mavlink;

    model_mavlink_gap(&model);

    keel_mavlink_gap(&mavlink);

    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_010_model: every field is what the model says");
}
