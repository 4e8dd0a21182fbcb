/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file told_drop.h
 * @brief What stands for keel_mavlink_drop, and for its model, in the harnesses of its callers: any
 *        bytes that its contract allows are left, and any count of others. When the model drops
 *        bytes, the code must drop as many from the same decoder, and is left the same.
 */
#ifndef TOLD_DROP_H
#define TOLD_DROP_H

#include "mavlink_contracts.h"

/* What is left, drawn at once. */
typedef struct {
    uint8_t bytes[KEEL_MAVLINK_FRAME_MAX];
    uint16_t held;
    uint32_t others;
} left_t;

left_t nondet_left(void);

static bool told_of_drop;
static uint32_t told_count;
static keel_mavlink_t told_before;
static left_t told_left;

static void leave(keel_mavlink_t *mavlink)
{
    for (uint32_t i = 0u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
        mavlink->bytes[i] = told_left.bytes[i];
    }
    mavlink->held = told_left.held;
    mavlink->awaited = 10u;
    mavlink->count.others = told_left.others;
}

void model_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count)
{
    told_of_drop = true;
    told_count = count;
    told_before = *mavlink;
    told_left = nondet_left();
    leave(mavlink);
    __CPROVER_assume(keel_mavlink_drop_does(mavlink, told_before.held, count));
}

void keel_mavlink_drop_stand_in(keel_mavlink_t *mavlink, uint32_t count)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);

    __CPROVER_assert(keel_mavlink_drop_may(mavlink, count), "precondition: keel_mavlink_drop");
    __CPROVER_assert(told_of_drop && (count == told_count) &&
                         mavlink_same(mavlink, &told_before, at),
                     "MAV_014_drop: as many as the model drops, of the same decoder");
    leave(mavlink);
    __CPROVER_assume(keel_mavlink_drop_does(mavlink, told_before.held, count));
}

#endif
