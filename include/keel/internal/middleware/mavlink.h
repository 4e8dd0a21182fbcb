/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/mavlink.h
 * @brief The contracts of mavlink.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_MAVLINK_H
#define KEEL_INTERNAL_MIDDLEWARE_MAVLINK_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/crc.h"
#include "keel/middleware/mavlink.h"

KEEL_C_BEGIN

/*@ // The first messages are in order: their ids ascend, and their lengths are ranges.
  @ predicate mavlink_table(keel_mavlink_message_t *messages, integer known) =
  @     (\forall integer i; 0 <= i < known ==>
  @         messages[i].id <= KEEL_MAVLINK_ID_MAX &&
  @         messages[i].shortest <= messages[i].longest) &&
  @     (\forall integer i, j; 0 <= i < j < known ==> messages[i].id < messages[j].id);
  @
  @ // Its message: the number in three bytes, the lowest first.
  @ logic integer mavlink_id(uint8_t *bytes) =
  @     bytes[7] + 256 * bytes[8] + 65536 * bytes[9];
  @
  @ // Where the checksum is, and how many bytes the frame has.
  @ logic integer mavlink_end(uint8_t *bytes) = KEEL_MAVLINK_HEADER_BYTES + bytes[1];
  @ logic integer mavlink_whole(uint8_t *bytes) =
  @     mavlink_end(bytes) + KEEL_MAVLINK_CHECKSUM_BYTES +
  @     (bytes[2] == 0 ? 0 : KEEL_MAVLINK_SIGNATURE_BYTES);
  @
  @ logic integer mavlink_sum(integer count) = count < UINT32_MAX ? count + 1 : UINT32_MAX;
  @
  @ // Its frame is of that message, and as long as one may be.
  @ predicate mavlink_is_of(uint8_t *bytes, keel_mavlink_message_t *message) =
  @     message->id == mavlink_id(bytes) && message->shortest <= bytes[1] <= message->longest;
  @
  @ // keel_crc16 comes to this.
  @ logic integer mavlink_crc16(integer crc, integer byte) =
  @     crc_down(crc ^ byte, KEEL_CRC16_POLYNOMIAL, 8) & 0xFFFF;
  @
  @ // The checksum of a frame's bytes before the end, and of its message's byte.
  @ logic integer mavlink_crc(uint8_t *bytes, integer end) =
  @     end <= 1 ? KEEL_CRC16_FIRST :
  @     mavlink_crc16(mavlink_crc(bytes, end - 1), bytes[end - 1]);
  @ logic integer mavlink_checksum(uint8_t *bytes, integer end, integer extra) =
  @     mavlink_crc16(mavlink_crc(bytes, end), extra);
  @
  @ // As it was sent, behind the payload.
  @ logic integer mavlink_sent(uint8_t *bytes) =
  @     bytes[mavlink_end(bytes)] + 256 * bytes[mavlink_end(bytes) + 1];
  @
  @ // The header may be one of that message: of no other one, as ids ascend.
  @ predicate mavlink_fits(uint8_t *bytes, keel_mavlink_message_t *message) =
  @     bytes[2] <= 1 && mavlink_is_of(bytes, message);
  @
  @ // A right frame begins with the first byte that is held, and all of it is.
  @ predicate mavlink_right(keel_mavlink_t *m) =
  @     m->held >= KEEL_MAVLINK_HEADER_BYTES && m->held >= mavlink_whole(&m->bytes[0]) &&
  @     \exists integer i; 0 <= i < m->known && mavlink_fits(&m->bytes[0], m->messages + i) &&
  @         mavlink_sent(&m->bytes[0]) == mavlink_checksum(&m->bytes[0],
  @             mavlink_end(&m->bytes[0]), m->messages[i].crc_extra);
  @
  @ // Between any two calls.
  @ predicate mavlink_valid(keel_mavlink_t *m) =
  @     m->held <= KEEL_MAVLINK_FRAME_MAX &&
  @     (m->held > 0 ==> m->bytes[0] == KEEL_MAVLINK_FIRST) &&
  @     (m->awaited != KEEL_MAVLINK_HEADER_BYTES ==> m->held >= KEEL_MAVLINK_HEADER_BYTES &&
  @         m->message < m->known && m->awaited == mavlink_whole(&m->bytes[0]) &&
  @         mavlink_fits(&m->bytes[0], m->messages + m->message));
  @
  @ // Bytes from the front are gone: count of them, and up to the next beginning. All others stay.
  @ predicate mavlink_dropped{L, M}(keel_mavlink_t *m, integer count) =
  @     \let n = \at(m->held, L) - \at(m->held, M);
  @     count <= n &&
  @     (\forall integer j; count <= j < n ==> \at(m->bytes[j], L) != KEEL_MAVLINK_FIRST) &&
  @     (\forall integer j; 0 <= j < \at(m->held, M) ==>
  @         \at(m->bytes[j], M) == \at(m->bytes[n + j], L));
  @
  @ predicate mavlink_apart(keel_mavlink_t *m) =
  @     \valid(m) && m->known <= KEEL_MAVLINK_MESSAGES_MAX &&
  @     \valid_read(m->messages + (0 .. m->known - 1)) &&
  @     \separated(m, m->messages + (0 .. m->known - 1)) &&
  @     mavlink_table(m->messages, m->known);
  @
  @ // The fields of a frame beside its payload and signature.
  @ predicate mavlink_header_of{L, M}(keel_mavlink_t *m) =
  @     \at(m->frame.length, M) == \at(m->bytes[1], L) &&
  @     (\at(m->frame.is_signed, M) != 0 <==> \at(m->bytes[2], L) != 0) &&
  @     \at(m->frame.compatible, M) == \at(m->bytes[3], L) &&
  @     \at(m->frame.sequence, M) == \at(m->bytes[4], L) &&
  @     \at(m->frame.system, M) == \at(m->bytes[5], L) &&
  @     \at(m->frame.component, M) == \at(m->bytes[6], L) &&
  @     \at(m->frame.id, M) == \at(mavlink_id(&m->bytes[0]), L) &&
  @     \at(m->frame.checksum, M) == \at(mavlink_sent(&m->bytes[0]), L);
  @
  @ predicate mavlink_kept{L, M}(keel_mavlink_t *m) =
  @     \at(m->frame.id, M) == \at(m->frame.id, L) &&
  @     \at(m->frame.sequence, M) == \at(m->frame.sequence, L) &&
  @     \at(m->frame.system, M) == \at(m->frame.system, L) &&
  @     \at(m->frame.component, M) == \at(m->frame.component, L) &&
  @     \at(m->frame.compatible, M) == \at(m->frame.compatible, L) &&
  @     \at(m->frame.length, M) == \at(m->frame.length, L) &&
  @     \at(m->frame.checksum, M) == \at(m->frame.checksum, L) &&
  @     \at(m->frame.is_signed, M) == \at(m->frame.is_signed, L) &&
  @     \at(m->frame.link, M) == \at(m->frame.link, L) &&
  @     \at(m->frame.timestamp, M) == \at(m->frame.timestamp, L) &&
  @     (\forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==>
  @         \at(m->frame.payload[i], M) == \at(m->frame.payload[i], L)) &&
  @     (\forall integer i; 0 <= i < KEEL_MAVLINK_SEAL_BYTES ==>
  @         \at(m->frame.seal[i], M) == \at(m->frame.seal[i], L));
  @
  @ // The part of a payload that is left without its trailing zeros.
  @ predicate mavlink_cut(uint8_t *payload, integer length, integer cut) =
  @     1 <= cut <= length && (cut > 1 ==> payload[cut - 1] != 0) &&
  @     \forall integer i; cut <= i < length ==> payload[i] == 0;
  @
  @ logic integer mavlink_room(keel_mavlink_sender_t *sender) =
  @     KEEL_MAVLINK_HEADER_BYTES + KEEL_MAVLINK_CHECKSUM_BYTES +
  @     (sender->is_signing != 0 ? KEEL_MAVLINK_SIGNATURE_BYTES : 0);
  @*/

/*@ requires \valid(mavlink) && \valid_read(messages + (0 .. known - 1)) &&
  @     \separated(mavlink, messages + (0 .. known - 1));
  @ assigns *mavlink;
  @ behavior full:
  @   assumes known > KEEL_MAVLINK_MESSAGES_MAX;
  @   assigns \nothing;
  @   ensures MAV_001_full: \result == KEEL_ERR_FULL;
  @ behavior table:
  @   assumes known <= KEEL_MAVLINK_MESSAGES_MAX && !mavlink_table(messages, known);
  @   assigns \nothing;
  @   ensures MAV_001_table: \result == KEEL_ERR_LIMITS;
  @ behavior made:
  @   assumes known <= KEEL_MAVLINK_MESSAGES_MAX && mavlink_table(messages, known);
  @   ensures MAV_002_made: \result == KEEL_OK && mavlink_valid(mavlink) &&
  @       mavlink_apart(mavlink) && mavlink->held == 0 &&
  @       mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @   ensures MAV_002_messages: mavlink->messages == messages && mavlink->known == known;
  @   ensures MAV_002_none: mavlink->count.frames == 0 && mavlink->frame.length == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                uint32_t known);

/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ assigns mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1], mavlink->held, mavlink->count.others;
  @ ensures MAV_003_valid: mavlink_valid(mavlink);
  @ behavior full:
  @   assumes mavlink->held >= KEEL_MAVLINK_FRAME_MAX;
  @   assigns \nothing;
  @   ensures MAV_008_full: \result == KEEL_ERR_FULL;
  @ behavior other:
  @   assumes mavlink->held == 0 && byte != KEEL_MAVLINK_FIRST;
  @   assigns mavlink->count.others;
  @   ensures MAV_008_other: \result == KEEL_OK &&
  @       mavlink->count.others == mavlink_sum(\old(mavlink->count.others));
  @ behavior held:
  @   assumes 0 < mavlink->held < KEEL_MAVLINK_FRAME_MAX ||
  @       (mavlink->held == 0 && byte == KEEL_MAVLINK_FIRST);
  @   assigns mavlink->bytes[mavlink->held], mavlink->held;
  @   ensures MAV_008_held: \result == KEEL_OK && mavlink->held == \old(mavlink->held) + 1 &&
  @       mavlink->bytes[\old(mavlink->held)] == byte;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte);

/*@ requires \valid(mavlink) && 1 <= count <= mavlink->held <= KEEL_MAVLINK_FRAME_MAX;
  @ assigns mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1], mavlink->held, mavlink->awaited,
  @     mavlink->count.others;
  @ ensures MAV_016_fewer: mavlink->held < \old(mavlink->held);
  @ ensures MAV_016_dropped: mavlink_dropped{Pre, Post}(mavlink, count);
  @ ensures MAV_016_begins: mavlink->held > 0 ==> mavlink->bytes[0] == KEEL_MAVLINK_FIRST;
  @ ensures MAV_016_header: mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @ ensures MAV_016_counted: mavlink->count.others == \min(UINT32_MAX,
  @     \old(mavlink->count.others) + \old(mavlink->held) - mavlink->held - count);
  @*/
void keel_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count);

/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ assigns mavlink->frame, mavlink->count, mavlink->message, mavlink->held, mavlink->awaited,
  @     mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures MAV_003_valid: mavlink_valid(mavlink);
  @ ensures MAV_004_right: \result == KEEL_MAVLINK_FRAME ==> \old(mavlink_right(mavlink));
  @ ensures MAV_004_dropped: \result == KEEL_MAVLINK_FRAME ==>
  @     mavlink_dropped{Pre, Post}(mavlink, \old(mavlink->awaited)) &&
  @     mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @ ensures MAV_005_header: \result == KEEL_MAVLINK_FRAME ==>
  @     mavlink_header_of{Pre, Post}(mavlink);
  @ ensures MAV_005_payload: \result == KEEL_MAVLINK_FRAME ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @         \old(i < mavlink->bytes[1] ? mavlink->bytes[KEEL_MAVLINK_HEADER_BYTES + i] : 0);
  @ ensures MAV_006_kept: \result != KEEL_MAVLINK_FRAME ==> mavlink_kept{Pre, Post}(mavlink);
  @ ensures MAV_007_frames: mavlink->count.frames == (\result == KEEL_MAVLINK_FRAME ?
  @     mavlink_sum(\old(mavlink->count.frames)) : \old(mavlink->count.frames));
  @ ensures MAV_009_nothing: \result == KEEL_MAVLINK_NOTHING <==>
  @     \old(mavlink->held) < \old(mavlink->awaited);
  @ ensures MAV_009_waits: \result == KEEL_MAVLINK_NOTHING ==>
  @     mavlink->held == \old(mavlink->held) && mavlink->awaited == \old(mavlink->awaited) &&
  @     \forall integer j; 0 <= j < KEEL_MAVLINK_FRAME_MAX ==>
  @         mavlink->bytes[j] == \old(mavlink->bytes[j]);
  @ ensures MAV_009_again: \result == KEEL_MAVLINK_AGAIN ==>
  @     mavlink->held < \old(mavlink->held) ||
  @     (\old(mavlink->awaited) == KEEL_MAVLINK_HEADER_BYTES &&
  @      mavlink->awaited > KEEL_MAVLINK_HEADER_BYTES && mavlink->held == \old(mavlink->held) &&
  @      \forall integer j; 0 <= j < KEEL_MAVLINK_FRAME_MAX ==>
  @         mavlink->bytes[j] == \old(mavlink->bytes[j]));
  @ ensures MAV_014_refused: \result == KEEL_MAVLINK_AGAIN &&
  @     mavlink->held < \old(mavlink->held) ==> !\old(mavlink_right(mavlink)) &&
  @         mavlink_dropped{Pre, Post}(mavlink, 1) &&
  @         mavlink->awaited == KEEL_MAVLINK_HEADER_BYTES;
  @*/
keel_mavlink_look_t keel_mavlink_look(keel_mavlink_t *mavlink);

/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ assigns mavlink->frame, mavlink->count, mavlink->message, mavlink->held, mavlink->awaited,
  @     mavlink->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures MAV_003_valid: mavlink_valid(mavlink);
  @ ensures MAV_010_nothing: \result == KEEL_MAVLINK_NOTHING <==> \old(mavlink->held) == 0;
  @ ensures MAV_010_empty: \result == KEEL_MAVLINK_NOTHING ==> mavlink->held == 0;
  @ ensures MAV_010_partial: 0 < \old(mavlink->held) < \old(mavlink->awaited) ==>
  @     \result == KEEL_MAVLINK_AGAIN && !\old(mavlink_right(mavlink)) &&
  @     mavlink_dropped{Pre, Post}(mavlink, 1) &&
  @     mavlink->count.gaps == mavlink_sum(\old(mavlink->count.gaps));
  @ ensures MAV_006_kept: \result != KEEL_MAVLINK_FRAME ==> mavlink_kept{Pre, Post}(mavlink);
  @ ensures MAV_010_right: \result == KEEL_MAVLINK_FRAME ==> \old(mavlink_right(mavlink));
  @*/
keel_mavlink_look_t keel_mavlink_gap(keel_mavlink_t *mavlink);

/*@ requires \valid(sender) && \valid_read(message) && \valid_read(payload + (0 .. length - 1)) &&
  @     \valid(packet) && \separated(sender, message, payload + (0 .. length - 1), packet);
  @ assigns sender->sequence, packet->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures MAV_011_refused: (length < 1 || length > message->longest ||
  @     message->id > KEEL_MAVLINK_ID_MAX) <==> \result == 0;
  @ ensures MAV_011_kept: \result == 0 ==> sender->sequence == \old(sender->sequence);
  @ ensures MAV_012_kept: \forall integer i; \result <= i < KEEL_MAVLINK_FRAME_MAX ==>
  @     packet->bytes[i] == \old(packet->bytes[i]);
  @ ensures MAV_012_header: \result > 0 ==> packet->bytes[0] == KEEL_MAVLINK_FIRST &&
  @     packet->bytes[3] == 0 &&
  @     packet->bytes[2] == (sender->is_signing != 0 ? 1 : 0) &&
  @     packet->bytes[4] == \old(sender->sequence) && packet->bytes[5] == sender->system &&
  @     packet->bytes[6] == sender->component && mavlink_id(&packet->bytes[0]) == message->id;
  @ ensures MAV_012_length: \result > 0 ==> mavlink_cut(payload, length, packet->bytes[1]) &&
  @     \result == mavlink_room(sender) + packet->bytes[1];
  @ ensures MAV_012_payload: \result > 0 ==> \forall integer i; 0 <= i < packet->bytes[1] ==>
  @     packet->bytes[KEEL_MAVLINK_HEADER_BYTES + i] == payload[i];
  @ ensures MAV_013_sequence: \result > 0 ==>
  @     sender->sequence == (\old(sender->sequence) + 1) % 256;
  @*/
uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet);

KEEL_C_END

#endif
