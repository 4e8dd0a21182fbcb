/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink_empty_lists.h
 * @brief What ground stations load from others, and the copter has none of: missions, fences,
 * rally points, and logs by telemetry.
 *
 * Each request is answered at once: a list is empty, and what would fill it is refused. Without an
 * answer a station asks again for many seconds, and tells its user of an error then.
 */
#ifndef COPTER_MAVLINK_EMPTY_LISTS_H
#define COPTER_MAVLINK_EMPTY_LISTS_H

#include "keel/middleware/mavlink.h"

#include <stdbool.h>
#include <stdint.h>

/** Answers that wait on a link. */
#define COPTER_REPLIES 8u

/** An answer that is to be sent. */
typedef struct copter_reply {
    uint32_t offset;   /**< In a log. */
    uint16_t log;      /**< Which. */
    uint8_t sent;      /**< SENT_MISSION_COUNT, SENT_MISSION_ACK, SENT_LOG_ENTRY, SENT_LOG_DATA. */
    uint8_t system;    /**< Who asked. */
    uint8_t component; /**< The same. */
    uint8_t kind;      /**< Of a mission: MAV_MISSION_TYPE_... */
    uint8_t result;    /**< MAV_MISSION_ACCEPTED, ... */
} copter_reply_t;

/** Answers, the oldest first. */
typedef struct copter_replies {
    copter_reply_t reply[COPTER_REPLIES];
    uint32_t count;
} copter_replies_t;

#endif
