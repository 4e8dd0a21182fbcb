// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/middleware/mavlink.c src/middleware/crc.c specs/model/mavlink.c
// covers: keel_mavlink_init
//
// One message more than there may be.
#include "../common/unchanged.h"
#include "mavlink_proof.h"

void keel_mavlink_init__many_harness(void)
{
    keel_mavlink_t mavlink = any_mavlink();
    const keel_mavlink_t before = mavlink;

    __CPROVER_assert(keel_mavlink_init(&mavlink, table, 257u) == KEEL_ERR_FULL,
                     "MAV_001_many: there are too many");
    __CPROVER_assert(unchanged(&mavlink, &before, sizeof(mavlink)),
                     "STA_001_kept: a refusal changes nothing");
}
