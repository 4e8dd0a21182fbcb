/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file every_byte.h
 * @brief Whether two decoders are the same in every byte: for harnesses of chosen points, where an
 *        arbitrary byte would need a solver.
 */
#ifndef EVERY_BYTE_H
#define EVERY_BYTE_H

#include "mavlink_contracts.h"

static bool every_byte_same(const keel_mavlink_t *a, const keel_mavlink_t *b)
{
    bool same = mavlink_same(a, b, 0u);

    for (uint32_t i = 0u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
        same = same && (a->bytes[i] == b->bytes[i]);
    }
    for (uint32_t i = 0u; i < KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        same = same && (a->frame.payload[i] == b->frame.payload[i]);
    }
    return same;
}

#endif
