// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// cbmc: --unwindset model_mavlink_drop.0:281
// sources: src/middleware/mavlink.c specs/model/mavlink_drop.c
// covers: keel_mavlink_drop count_met model_mavlink_drop
//
// Up to 8 bytes that are held, any of them dropped; each byte that is left. For as many as can be
// held, WP proves which are left (MAV_016_dropped).
#include "mavlink_contracts.h"

void keel_mavlink_drop_harness(void)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);
    const uint32_t count = nondet_u32();
    keel_mavlink_t mavlink = any_mavlink();
    const keel_mavlink_t before = mavlink;
    keel_mavlink_t model = mavlink;

    __CPROVER_assume(keel_mavlink_drop_may(&mavlink, count) && (mavlink.held <= 8u));
    model_mavlink_drop(&model, count);

    keel_mavlink_drop(&mavlink, count);

    __CPROVER_assert(mavlink_same(&mavlink, &model, at),
                     "MAV_016_model: every field is what the model says");
    __CPROVER_assert(keel_mavlink_drop_does(&mavlink, before.held, count),
                     "MAV_016_begins: what is left begins with a beginning");
}
