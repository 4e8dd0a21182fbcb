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
 * The decoder takes a frame when it is right as a whole; nothing else changes what it tells. It
 * holds bytes from a beginning on until it can tell whether a right frame begins there. When none
 * does, it goes on at the next 0xFD behind that byte, among the bytes that it holds. So a right
 * frame is taken whatever came before it, unless it begins within another one that was taken: by
 * its last byte, or, when bytes before it look like a beginning, at most 265 bytes later, or when
 * a gap is reported.
 *
 *     (void)keel_mavlink_take(&mavlink, byte);
 *     while ((seen = keel_mavlink_look(&mavlink)) != KEEL_MAVLINK_NOTHING) {
 *         if (seen == KEEL_MAVLINK_FRAME) {
 *             act_on(&mavlink.frame);
 *         }
 *     }
 *
 * A look reads at most one header, or sums up at most one frame, so its time is bounded. One byte
 * may decide about several beginnings; each is looked at no more than twice, so looks that do not
 * find nothing are never more than twice the bytes that came.
 *
 * Where a frame cannot lie in two pieces, as in datagrams, or the line was silent, the bytes that
 * are held are all that come: keel_mavlink_gap is called instead of keel_mavlink_look, again until
 * it finds nothing.
 *
 * The payload of a frame that is not taken is searched, too: that of a message that is not known
 * may hold a frame, and that one is taken. Its length may not be believed, as its checksum cannot
 * be checked. Whoever wants the payloads of a message left alone adds it to the messages that are
 * known; what must not be acted on for any other reason, signatures prevent.
 *
 * Frames of MAVLink 1, which begin with 0xFE, are not taken: their bytes are counted as others.
 *
 * A signed frame is taken here without a look at its signature; keel/middleware/signing.h
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
    uint8_t crc_extra; /**< Stands for its layout, by its definition. */
    uint8_t shortest;  /**< The fewest bytes that a frame of it may have. As trailing zeros are left
                            out, senders make do with 1, however long the message is. */
    uint8_t longest;   /**< The most; not below shortest. The length of all its fields, or
                            KEEL_MAVLINK_PAYLOAD_MAX for senders who know more fields than we. */
} keel_mavlink_message_t;

/** The contents of a frame. */
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

/** Counts since the start. */
typedef struct keel_mavlink_count {
    uint32_t frames;    /**< Right frames. */
    uint32_t checksums; /**< Beginnings refused for the checksum, */
    uint32_t unknown;   /**< for a message that is not known, */
    uint32_t lengths;   /**< for a length that is not of their message, */
    uint32_t flags;     /**< for a flag that nobody knows, */
    uint32_t gaps;      /**< or as a gap came before their last byte. */
    uint32_t others;    /**< Bytes that are of no frame and no beginning. */
} keel_mavlink_count_t;

/** The finding of a look at the bytes that are held. */
typedef enum keel_mavlink_look {
    KEEL_MAVLINK_NOTHING, /**< More bytes are needed. */
    KEEL_MAVLINK_AGAIN,   /**< No frame yet: look again. */
    KEEL_MAVLINK_FRAME    /**< A right frame: look again when it was read. */
} keel_mavlink_look_t;

/** A decoder. Only the functions below write it; all of it may be read. */
typedef struct keel_mavlink {
    const keel_mavlink_message_t *messages; /**< The messages that are known, */
    uint32_t known;                         /**< and how many there are. */
    keel_mavlink_frame_t frame;             /**< The last right frame; all 0 before. */
    keel_mavlink_count_t count;             /**< Counts of events. */
    uint32_t message;                       /**< The place of the last header's message that fit. */
    uint16_t held;                          /**< How many bytes are held. */
    uint16_t awaited; /**< How many the next look needs: a header, or, when that fits, the frame. */
    uint8_t bytes[KEEL_MAVLINK_FRAME_MAX]; /**< Those held, and behind them what was before. */
} keel_mavlink_t;

/** A sender. Two senders of one system and component share one. */
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

/**
 * Makes a decoder (requirements MAV-001 and MAV-002).
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
 * Takes a byte from the line (requirement MAV-008). keel_mavlink_look finds the frame that it ends.
 *
 * @param mavlink the decoder, initialised
 * @param byte    what came
 * @return KEEL_OK; KEEL_ERR_FULL when KEEL_MAVLINK_FRAME_MAX bytes are held, which is never so
 *         behind a look that found nothing: then nothing is changed
 */
keel_status_t keel_mavlink_take(keel_mavlink_t *mavlink, uint8_t byte);

/**
 * Drops bytes from the front, and those behind them up to the next 0xFD, which are counted
 * (requirement MAV-016). A part of keel_mavlink_look; whoever else calls it may lose frames.
 *
 * @param mavlink the decoder, with so many bytes
 * @param count   how many, at least 1
 */
void keel_mavlink_drop(keel_mavlink_t *mavlink, uint32_t count);

/**
 * Looks whether a right frame begins with the first byte that is held (requirements MAV-003 to
 * MAV-009 and MAV-014). Call it again until it finds nothing, before the next byte is taken.
 *
 * @param mavlink the decoder, initialised
 * @return what was found. A frame is in mavlink->frame until the next one; otherwise that is as it
 *         was
 */
keel_mavlink_look_t keel_mavlink_look(keel_mavlink_t *mavlink);

/**
 * Looks as keel_mavlink_look does, when no byte will follow those that are held: a frame that is
 * not whole is none (requirement MAV-010). Call it again until it finds nothing: then nothing is
 * held. A driver that knows no gaps need not call it.
 *
 * @param mavlink the decoder, initialised
 * @return as keel_mavlink_look
 */
keel_mavlink_look_t keel_mavlink_gap(keel_mavlink_t *mavlink);

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
uint16_t keel_mavlink_write(keel_mavlink_sender_t *sender, const keel_mavlink_message_t *message,
                            const uint8_t *payload, uint8_t length, keel_mavlink_packet_t *packet);

KEEL_C_END

#endif
