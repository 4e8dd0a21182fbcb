/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink.h
 * @brief What the functions of keel/middleware/mavlink.h do.
 */
#ifndef MODEL_MAVLINK_H
#define MODEL_MAVLINK_H

#include "keel/middleware/mavlink.h"

keel_status_t model_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                 uint32_t known);
keel_status_t model_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte);
void model_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count);
keel_mavlink_look_t model_mavlink_look(keel_mavlink_t *mavlink);
keel_mavlink_look_t model_mavlink_gap(keel_mavlink_t *mavlink);
uint16_t model_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                             const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet);

/* The bytes of a frame that begins with these (with its length and flags), and what the whole frame
 * says: what the proofs and tests say frames by. */
uint32_t model_mavlink_whole(const uint8_t *header);
keel_mavlink_frame_t model_mavlink_frame(const uint8_t *bytes);

/* The checksum of a whole frame, the byte of its message included. */
uint16_t model_mavlink_checksum(const uint8_t *bytes, uint8_t crc_extra);

#endif
