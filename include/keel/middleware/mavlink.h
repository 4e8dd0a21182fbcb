/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mavlink.h
 * @brief Frames of MAVLink 2: a decoder, byte by byte, and an encoder.
 *
 * A frame is the byte 0xFD, nine bytes that say what it is, a payload of up to 255 bytes whose
 * trailing zeros are left out, a checksum of two bytes, and, when it is signed, a signature of 13.
 * The checksum begins where the length is, and ends with a byte that is not sent and stands for the
 * layout of the message, so a frame can be checked only when its message is known.
 *
 * The decoder takes a frame when it is right as a whole; nothing else changes what it tells. When a
 * beginning cannot be one, for a flag that nobody knows, it looks for the next from the very next
 * byte on. Otherwise it skips as many bytes as the frame says that it has: bytes in a payload that
 * look like a frame are none, nor are those of a message that is not known. So a beginning that was
 * none costs the frames that begin in the next 279 bytes; a driver that tells the gaps of its line
 * ends that at the next gap. The time for a byte is bounded, whatever came before.
 *
 * Frames of MAVLink 1, which begin with 0xFE, are not taken: their bytes are counted as others.
 *
 * What is signed is taken here without a look at its signature; keel/middleware/signing.h
 * tells whether it is right.
 *
 * All is integer arithmetic. All counts stay at UINT32_MAX.
 */
#ifndef KEEL_MIDDLEWARE_MAVLINK_H
#define KEEL_MIDDLEWARE_MAVLINK_H

#include "keel/c_declarations.h"
#include "keel/middleware/crc.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The first byte of a frame. */
#define KEEL_MAVLINK_FIRST 0xFD

/** The largest payload, in bytes. */
#define KEEL_MAVLINK_PAYLOAD_MAX 255

/** Bytes before the payload. */
#define KEEL_MAVLINK_HEADER_BYTES 10

/** Bytes of the checksum, behind the payload. */
#define KEEL_MAVLINK_CHECKSUM_BYTES 2

/** Bytes of a signature, behind the checksum. */
#define KEEL_MAVLINK_SIGNATURE_BYTES 13

/** Bytes behind the payload, at most. */
#define KEEL_MAVLINK_TAIL_MAX 15

/** Of a signature's the last ones, which the key is needed for. */
#define KEEL_MAVLINK_SEAL_BYTES 6

/** The longest frame: all of these. */
#define KEEL_MAVLINK_FRAME_MAX 280

/** The largest id of a message. */
#define KEEL_MAVLINK_ID_MAX 0xFFFFFF

/** The most messages that a decoder can know. */
#define KEEL_MAVLINK_MESSAGES_MAX 256

/** A message that is known. */
typedef struct keel_mavlink_message {
    uint32_t id;       /**< 0 to KEEL_MAVLINK_ID_MAX. */
    uint8_t crc_extra; /**< What stands for its layout, by its definition. */
    uint8_t shortest;  /**< The fewest bytes that a frame of it may have. As trailing zeros are left
                            out, senders make do with 1, however long the message is. */
    uint8_t longest;   /**< The most; not below shortest. The length of all its fields, or
                            KEEL_MAVLINK_PAYLOAD_MAX for senders who know more fields than we. */
} keel_mavlink_message_t;

/** What a frame says. */
typedef struct keel_mavlink_frame {
    uint32_t id;        /**< Its message. */
    uint8_t sequence;   /**< Counts the sender's frames, modulo 256. */
    uint8_t system;     /**< The sender: a vehicle, a ground station, */
    uint8_t component;  /**< and a part of it. */
    uint8_t compatible; /**< Flags that make no difference to a decoder that does not know them. */
    uint8_t length;     /**< Bytes of the payload as they were sent. */
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX]; /**< Little-endian; 0 from length on. */
    uint16_t checksum;                         /**< As it was sent, and right. */
    bool is_signed;                            /**< It has a signature, right or wrong. */
    uint8_t link;       /**< The signature's link; 0 when there is none, as the next two. */
    uint64_t timestamp; /**< Its time, 48 bits, in 10 us since 2015 began (UTC). */
    uint8_t seal[KEEL_MAVLINK_SEAL_BYTES]; /**< The rest of it. */
} keel_mavlink_frame_t;

/** What was met since the start. */
typedef struct keel_mavlink_count {
    uint32_t frames;    /**< Right frames. */
    uint32_t checksums; /**< Frames refused for their checksum. */
    uint32_t unknown;   /**< Frames skipped, as their message is not known. */
    uint32_t lengths;   /**< Frames skipped for a length that is not of their message. */
    uint32_t flags;     /**< Beginnings refused for a flag that nobody knows. */
    uint32_t others;    /**< Bytes that were no beginning where a frame should begin. */
    uint32_t gaps;      /**< Partial frames that a gap ended. */
} keel_mavlink_count_t;

/** A decoder. Written by the functions below alone; all of it may be read. */
typedef struct keel_mavlink {
    const keel_mavlink_message_t *messages;    /**< The messages that are known, */
    uint32_t known;                            /**< and how many there are. */
    keel_mavlink_frame_t frame;                /**< The last right frame; all 0 before. */
    keel_mavlink_count_t count;                /**< What was met. */
    uint8_t header[KEEL_MAVLINK_HEADER_BYTES]; /**< A partial frame: its first bytes, */
    uint8_t payload[KEEL_MAVLINK_PAYLOAD_MAX]; /**< its payload, */
    uint8_t tail[KEEL_MAVLINK_TAIL_MAX];       /**< and what is behind that. */
    uint16_t held;                             /**< Its bytes, fewer than it says that it has. */
    uint16_t crc;                              /**< Of its bytes that count for it. */
    uint32_t message; /**< With its header: its message's place; known when it is skipped. */
} keel_mavlink_t;

/** Who sends. Two senders of one system and component share one. */
typedef struct keel_mavlink_sender {
    uint8_t system;    /**< 1 to 255. */
    uint8_t component; /**< 1 to 255. */
    uint8_t sequence;  /**< Of the next frame; counted by keel_mavlink_write. */
    bool is_signing;   /**< Frames have room for a signature, which is 0 until it is written. Set by
                            keel_signing_write; otherwise false. */
} keel_mavlink_sender_t;

/** A frame as it goes over a line. */
typedef struct keel_mavlink_packet {
    uint8_t bytes[KEEL_MAVLINK_FRAME_MAX]; /**< As many as keel_mavlink_write says are of it. */
} keel_mavlink_packet_t;

/*@ // The first messages are in order: their ids ascend, and their lengths are ranges.
  @ predicate mavlink_table(keel_mavlink_message_t *messages, integer known) =
  @     \forall integer i; 0 <= i < known ==>
  @         messages[i].id <= KEEL_MAVLINK_ID_MAX &&
  @         messages[i].shortest <= messages[i].longest &&
  @         (i > 0 ==> messages[i - 1].id < messages[i].id);
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
  @ // Between any two calls.
  @ predicate mavlink_valid(keel_mavlink_t *m) =
  @     m->held < KEEL_MAVLINK_FRAME_MAX &&
  @     (m->held > 0 ==> m->header[0] == KEEL_MAVLINK_FIRST) &&
  @     (m->held > 2 ==> m->header[2] <= 1 && m->held < mavlink_whole(&m->header[0])) &&
  @     (m->held >= KEEL_MAVLINK_HEADER_BYTES ==> m->message <= m->known) &&
  @     (m->held >= KEEL_MAVLINK_HEADER_BYTES && m->message < m->known ==>
  @         mavlink_is_of(&m->header[0], m->messages + m->message));
  @
  @ predicate mavlink_apart(keel_mavlink_t *m) =
  @     \valid(m) && m->known <= KEEL_MAVLINK_MESSAGES_MAX &&
  @     \valid_read(m->messages + (0 .. m->known - 1)) &&
  @     \separated(m, m->messages + (0 .. m->known - 1));
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
  @ // What is left of a payload without its trailing zeros.
  @ predicate mavlink_cut(uint8_t *payload, integer length, integer cut) =
  @     1 <= cut <= length && (cut > 1 ==> payload[cut - 1] != 0) &&
  @     \forall integer i; cut <= i < length ==> payload[i] == 0;
  @
  @ logic integer mavlink_room(keel_mavlink_sender_t *sender) =
  @     KEEL_MAVLINK_HEADER_BYTES + KEEL_MAVLINK_CHECKSUM_BYTES +
  @     (sender->is_signing != 0 ? KEEL_MAVLINK_SIGNATURE_BYTES : 0);
  @*/

/**
 * Makes a decoder (requirements MAV-001 and MAV-002).
 *
 * @param mavlink  the decoder
 * @param messages the messages that it knows, by ascending ids; they stay where they are
 * @param known    how many, 0 to KEEL_MAVLINK_MESSAGES_MAX
 * @return KEEL_OK; KEEL_ERR_FULL when there are more; KEEL_ERR_LIMITS when ids do not ascend, one
 *         is above KEEL_MAVLINK_ID_MAX, or shortest above longest; then nothing is changed
 */
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
  @       mavlink_apart(mavlink) && mavlink->held == 0;
  @   ensures MAV_002_messages: mavlink->messages == messages && mavlink->known == known;
  @   ensures MAV_002_none: mavlink->count.frames == 0 && mavlink->frame.length == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                uint32_t known);

/**
 * Takes a byte from the line (requirements MAV-003 to MAV-009).
 *
 * @param mavlink the decoder, initialised
 * @param byte    what came
 * @return whether it ended a right frame: it is in mavlink->frame then, until the next one.
 *         Otherwise that is as it was
 */
/*@ requires mavlink_apart(mavlink) && mavlink_valid(mavlink);
  @ assigns mavlink->frame, mavlink->count,
  @     mavlink->header[0 .. KEEL_MAVLINK_HEADER_BYTES - 1],
  @     mavlink->payload[0 .. KEEL_MAVLINK_PAYLOAD_MAX - 1],
  @     mavlink->tail[0 .. KEEL_MAVLINK_TAIL_MAX - 1], mavlink->held, mavlink->crc,
  @     mavlink->message;
  @ ensures MAV_003_valid: mavlink_valid(mavlink) && mavlink_apart(mavlink);
  @ ensures MAV_004_whole: \result ==> mavlink->held == 0 && \old(mavlink->held) > 2 &&
  @     \old(mavlink->held) + 1 == \old(mavlink_whole(&mavlink->header[0]));
  @ ensures MAV_004_message: \result ==> \old(mavlink->message < mavlink->known &&
  @     mavlink_is_of(&mavlink->header[0], mavlink->messages + mavlink->message));
  @ ensures MAV_005_header: \result ==> mavlink->frame.length == \old(mavlink->header[1]) &&
  @     mavlink->frame.is_signed == \old(mavlink->header[2]) &&
  @     mavlink->frame.compatible == \old(mavlink->header[3]) &&
  @     mavlink->frame.sequence == \old(mavlink->header[4]) &&
  @     mavlink->frame.system == \old(mavlink->header[5]) &&
  @     mavlink->frame.component == \old(mavlink->header[6]) &&
  @     mavlink->frame.id == \old(mavlink_id(&mavlink->header[0]));
  @ ensures MAV_005_payload: \result ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_PAYLOAD_MAX ==> mavlink->frame.payload[i] ==
  @         \old(i < mavlink->header[1] ? mavlink->payload[i] : 0);
  @ ensures MAV_006_kept: !\result ==> mavlink_kept{Pre, Post}(mavlink);
  @ ensures MAV_007_frames: mavlink->count.frames ==
  @     (\result ? mavlink_sum(\old(mavlink->count.frames)) : \old(mavlink->count.frames));
  @ ensures MAV_008_held: \old(mavlink->held) > 2 &&
  @     \old(mavlink->held) + 1 < \old(mavlink_whole(&mavlink->header[0])) ==>
  @         !\result && mavlink->held == \old(mavlink->held) + 1;
  @ ensures MAV_008_ended: \old(mavlink->held) > 2 &&
  @     \old(mavlink->held) + 1 >= \old(mavlink_whole(&mavlink->header[0])) ==>
  @         mavlink->held == 0;
  @ ensures MAV_008_header: mavlink->held == \old(mavlink->held) + 1 ==>
  @     \forall integer i; 0 <= i < KEEL_MAVLINK_HEADER_BYTES ==> mavlink->header[i] ==
  @         (i == \old(mavlink->held) ? byte : \old(mavlink->header[i]));
  @ ensures MAV_008_payload: \old(mavlink->held) > 2 ==>
  @     \forall integer i; 0 <= i < \old(mavlink->header[1]) ==> mavlink->payload[i] ==
  @         (KEEL_MAVLINK_HEADER_BYTES + i == \old(mavlink->held) ? byte :
  @             \old(mavlink->payload[i]));
  @ ensures MAV_008_first: \old(mavlink->held) == 0 ==> !\result &&
  @     mavlink->held == (byte == KEEL_MAVLINK_FIRST ? 1 : 0) &&
  @     (byte == KEEL_MAVLINK_FIRST ==> mavlink->crc == KEEL_CRC16_FIRST);
  @*/
bool keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte);

/**
 * Tells that the line was silent for longer than it is within a frame: the next byte begins one
 * (requirement MAV-010). A driver that knows no gaps need not call it.
 *
 * @param mavlink the decoder, initialised
 */
/*@ requires \valid(mavlink);
  @ assigns mavlink->count.gaps, mavlink->held;
  @ ensures MAV_010_begin: mavlink->held == 0;
  @ ensures MAV_010_counted: mavlink->count.gaps ==
  @     (\old(mavlink->held) > 0 ? mavlink_sum(\old(mavlink->count.gaps)) :
  @         \old(mavlink->count.gaps));
  @*/
void keel_mavlink_gap(keel_mavlink_t *mavlink);

/**
 * Writes a frame (requirements MAV-011 to MAV-013). Trailing zeros of the payload are left out, but
 * for its first byte.
 *
 * @param sender  who sends; its sequence is counted when the frame is written
 * @param message what the payload is of
 * @param payload little-endian, in the order of the message's definition (the largest types first)
 * @param length  its bytes, 1 to message->longest
 * @param packet  where the frame goes; what is behind it stays
 * @return the bytes of the frame; 0 when length is not in its range or the message's id above
 *         KEEL_MAVLINK_ID_MAX: then nothing is written
 */
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
