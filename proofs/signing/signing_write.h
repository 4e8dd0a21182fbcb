/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file signing_write.h
 * @brief What the harnesses of writing share: a frame that may be any, for model and code.
 */
#ifndef SIGNING_WRITE_H
#define SIGNING_WRITE_H

#include "signing_proof.h"

keel_mavlink_message_t nondet_message(void);
keel_mavlink_packet_t nondet_packet(void);

/* The frame that there is to be, and how many bytes it has: 0 when none is. */
static keel_mavlink_packet_t told;
static uint16_t told_whole;

/* What the model asked for. */
static const keel_mavlink_message_t *told_message;
static const uint8_t *told_payload;
static uint8_t told_length;

static void begin_frame(void)
{
    told = nondet_packet();
    told_whole = nondet_u16();
}

static keel_mavlink_sender_t any_sender(void)
{
    const keel_mavlink_sender_t sender = {nondet_u8(), nondet_u8(), nondet_u8(), nondet_bool()};

    return sender;
}

/* Of any frame and sender what keel_mavlink_write leaves: bytes behind the frame, and all of them
 * without one. */
static uint16_t tell(keel_mavlink_sender_t *sender, keel_mavlink_packet_t *packet)
{
    if (told_whole > 0u) {
        for (uint32_t i = 0u; i < KEEL_MAVLINK_FRAME_MAX; i++) {
            packet->bytes[i] = (i < told_whole) ? told.bytes[i] : packet->bytes[i];
        }
        sender->sequence = (uint8_t)((sender->sequence + 1u) & 0xFFu);
    }
    return told_whole;
}

uint16_t model_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                             const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet)
{
    const uint32_t room = sender->is_signing ? 25u : 12u;

    told_message = message;
    told_payload = payload;
    told_length = length;
    __CPROVER_assume((told_whole == 0u) || ((room < told_whole) && (told_whole <= (room + 255u))));
    return tell(sender, packet);
}

uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet)
{
    const uint32_t room = sender->is_signing ? 25u : 12u;

    __CPROVER_assert((message == told_message) && (payload == told_payload) &&
                         (length == told_length),
                     "SGN_011_message: of the same message and payload");
    __CPROVER_assume((told_whole == 0u) || ((room < told_whole) && (told_whole <= (room + 255u))));
    return tell(sender, packet);
}

static bool packet_same(const keel_mavlink_packet_t *a, const keel_mavlink_packet_t *b, uint32_t i)
{
    return a->bytes[i] == b->bytes[i];
}

#endif
