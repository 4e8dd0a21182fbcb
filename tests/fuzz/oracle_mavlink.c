/* SPDX-License-Identifier: Apache-2.0 */
/* MAVLink's own parser, as pymavlink generates it, without a look at signatures. */
#include "oracles.h"

#include <common/mavlink.h>

#include <string.h>

bool oracle_mavlink(const uint8_t *frame, size_t size, oracle_mavlink_t *said)
{
    static mavlink_message_t held;
    static mavlink_message_t message;
    static mavlink_status_t status;
    mavlink_status_t told;
    uint8_t last = MAVLINK_FRAMING_INCOMPLETE;

    memset(&held, 0, sizeof held);
    memset(&status, 0, sizeof status);
    memset(&message, 0, sizeof message);
    for (size_t i = 0u; i < size; i++) {
        last = mavlink_frame_char_buffer(&held, &status, frame[i], &message, &told);
    }
    if (last != MAVLINK_FRAMING_OK) {
        return false;
    }
    said->id = message.msgid;
    said->sequence = message.seq;
    said->system = message.sysid;
    said->component = message.compid;
    said->length = message.len;
    memset(said->payload, 0, sizeof said->payload);
    memcpy(said->payload, message.payload64, message.len);
    return true;
}
