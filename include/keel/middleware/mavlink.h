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
 * What is signed is taken here without a look at its signature; keel/middleware/signing.h tells
 * whether it is right.
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

/** Of those the last ones, which the key is needed for. */
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
    const keel_mavlink_message_t *messages; /**< The messages that are known, */
    uint32_t known;                         /**< and how many there are. */
    keel_mavlink_frame_t frame;             /**< The last right frame; all 0 before. */
    keel_mavlink_count_t count;             /**< What was met. */
    uint8_t bytes[KEEL_MAVLINK_FRAME_MAX];  /**< A partial frame, and behind it what was before. */
    uint16_t held;                          /**< Its bytes, fewer than it says that it has. */
    uint16_t crc;                           /**< Of its bytes that count for it. */
    uint8_t crc_extra;                      /**< Of its message, once that is known. */
    bool is_skipped;                        /**< It will not be taken. */
} keel_mavlink_t;

/** Who sends. Two senders of one system and component share one. */
typedef struct keel_mavlink_sender {
    uint8_t system;    /**< 1 to 255. */
    uint8_t component; /**< 1 to 255. */
    uint8_t sequence;  /**< Of the next frame; counted by keel_mavlink_write. */
    bool is_signing;   /**< Frames have room for a signature, which is 0 until it is written. Set by
                            keel_signing_write; otherwise false. */
} keel_mavlink_sender_t;

/**
 * Makes a decoder.
 *
 * @param mavlink  the decoder
 * @param messages the messages that it knows, by ascending ids; they stay where they are
 * @param known    how many, 0 to KEEL_MAVLINK_MESSAGES_MAX
 * @return KEEL_OK; KEEL_ERR_FULL when there are more; KEEL_ERR_LIMITS when ids do not ascend, one
 *         is above KEEL_MAVLINK_ID_MAX, or shortest above longest; then nothing is changed
 */
keel_status_t keel_mavlink_init(keel_mavlink_t *mavlink, const keel_mavlink_message_t *messages,
                                uint32_t known);

/**
 * Takes a byte from the line.
 *
 * @param mavlink the decoder, initialised
 * @param byte    what came
 * @return whether it ended a right frame: it is in mavlink->frame then, until the next one.
 *         Otherwise that is as it was
 */
bool keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte);

/**
 * Tells that the line was silent for longer than it is within a frame: the next byte begins one. A
 * driver that knows no gaps need not call it.
 *
 * @param mavlink the decoder, initialised
 */
void keel_mavlink_gap(keel_mavlink_t *mavlink);

/**
 * Writes a frame. Trailing zeros of the payload are left out, but for its first byte.
 *
 * @param sender  who sends; its sequence is counted when the frame is written
 * @param message what the payload is of
 * @param payload little-endian, in the order of the message's definition (the largest types first)
 * @param length  its bytes, 1 to 255; not above message->longest
 * @param out     where the frame goes; not the payload
 * @param size    the room there, in bytes; KEEL_MAVLINK_FRAME_MAX is enough for any
 * @return the bytes of the frame; 0 when length is not in its range or the frame does not fit: then
 *         nothing is written
 */
uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, uint8_t *out, uint32_t size);

KEEL_C_END

#endif
