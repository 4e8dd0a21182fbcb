/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file told_look.h
 * @brief What stands for keel_mavlink_look, and for its model: any decoder that its contract allows
 *        is left, and anything found. When the model looks, the code must look at the same decoder,
 *        and is left and told the same.
 */
#ifndef TOLD_LOOK_H
#define TOLD_LOOK_H

#include "mavlink_contracts.h"

static const keel_mavlink_look_t any_seen[3] = {KEEL_MAVLINK_NOTHING, KEEL_MAVLINK_AGAIN,
                                                KEEL_MAVLINK_FRAME};
static bool told_of_look;
static keel_mavlink_t told_looked_at;
static keel_mavlink_t told_looked;
static keel_mavlink_look_t told_seen;

keel_mavlink_look_t model_mavlink_look(keel_mavlink_t *mavlink)
{
    told_of_look = true;
    told_looked_at = *mavlink;
    *mavlink = nondet_mavlink();
    mavlink->messages = told_looked_at.messages;
    mavlink->known = told_looked_at.known;
    mavlink->frame.is_signed = nondet_bool();
    __CPROVER_assume(keel_mavlink_look_does(mavlink));
    told_looked = *mavlink;
    told_seen = any_seen[any_below(3u)];
    return told_seen;
}

keel_mavlink_look_t keel_mavlink_look_stand_in(keel_mavlink_t *mavlink)
{
    const uint32_t at = any_below(KEEL_MAVLINK_FRAME_MAX);

    __CPROVER_assert(keel_mavlink_look_may(mavlink), "precondition: keel_mavlink_look");
    __CPROVER_assert(told_of_look && mavlink_same(mavlink, &told_looked_at, at),
                     "MAV_010_look: at the decoder that the model looks at");
    *mavlink = told_looked;
    __CPROVER_assume(keel_mavlink_look_does(mavlink));
    return told_seen;
}

#endif
