/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file signing.h
 * @brief Signatures of MAVLink 2: who may tell the vehicle what, and frames that were recorded.
 *
 * The key's owner can sign: a signature is a link, a time, and the first bytes of the hash of
 * key, frame, link and time. Once a key is set, frames without a right signature are refused, and
 * so are frames that are not newer than the last one of their stream (a system, a component and a
 * link), or of a new stream and more than a minute behind our time. Without a key all frames are
 * taken, signed or not, as nothing can be checked.
 *
 * Our time is that of the last frame that was signed or accepted. It never goes back, so that no
 * two of our frames bear the same time. Across restarts that is the caller's part: store
 * signing.timestamp now and then, as often as the minute allows, and give keel_signing_advance what
 * was stored, plus the longest time between two stores, plus KEEL_SIGNING_MINUTE. Then frames from
 * before the restart are old for whoever forgot the streams, us included. With a clock that knows
 * the date, give it that, too. When all streams are in use new ones are refused, until a key is
 * set.
 *
 * The hash, SHA256, comes from outside, as a function that whoever builds Keel into a program
 * gives (assumption A-42).
 */
#ifndef KEEL_MIDDLEWARE_SIGNING_H
#define KEEL_MIDDLEWARE_SIGNING_H

#include "keel/c_declarations.h"
#include "keel/middleware/mavlink.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

#define KEEL_SIGNING_KEY_BYTES 32 /**< Bytes of a key. */

#define KEEL_SIGNING_DIGEST_BYTES 32 /**< Bytes of a hash. */

#define KEEL_SIGNING_STREAMS 8 /**< The most streams at a time. */

#define KEEL_SIGNING_MINUTE 6000000u /**< In 10 us. A new stream may be so much behind our time. */

#define KEEL_SIGNING_TIME_MAX 0xFFFFFFFFFFFFu /**< The last time: 48 bits end in the year 2104. */

#define KEEL_SIGNING_TEXT_MAX 306 /**< Bytes that are hashed: 32 + 280 - 6, key and frame. */

/**
 * The SHA256 of some bytes (FIPS 180-4). It writes nothing but the digest.
 *
 * @param data   the bytes
 * @param size   how many, at most KEEL_SIGNING_TEXT_MAX
 * @param digest where it goes, KEEL_SIGNING_DIGEST_BYTES bytes
 */
typedef void (*keel_signing_hash_fn_t)(const uint8_t *data, uint32_t size, uint8_t *digest);

/** A sender on a link, and how far it is. */
typedef struct keel_signing_stream {
    uint64_t timestamp; /**< Of its last frame that was accepted. */
    uint8_t system;     /**< The sender: a system, */
    uint8_t component;  /**< a part of it, */
    uint8_t link;       /**< and the number that it gave to the link. */
} keel_signing_stream_t;

/** Counts since the start. */
typedef struct keel_signing_count {
    uint32_t accepted; /**< Frames with a right signature. */
    uint32_t missing;  /**< Frames refused as they had none. */
    uint32_t wrong;    /**< Frames refused as theirs was wrong. */
    uint32_t replayed; /**< Frames refused as they were not newer than the last of their stream. */
    uint32_t old;      /**< Frames of a new stream refused as they were more than a minute old. */
    uint32_t full;     /**< Frames of a new stream refused as there is no room for one. */
} keel_signing_count_t;

/** A key and what was signed with it. Only the functions below write it. It holds the key. */
typedef struct keel_signing {
    keel_signing_stream_t stream[KEEL_SIGNING_STREAMS]; /**< The streams, */
    uint32_t streams;                                   /**< and how many there are. */
    keel_signing_count_t count;                         /**< Counts of events. */
    keel_signing_hash_fn_t hash;                        /**< SHA256. */
    uint64_t timestamp;                  /**< Our time, in 10 us since 2015 began (UTC). */
    uint8_t text[KEEL_SIGNING_TEXT_MAX]; /**< The hash's input: the key, and then a frame. */
    uint8_t link;                        /**< The number that we give to our link. */
    bool has_key;                        /**< A key is set: frames are signed and checked. */
} keel_signing_t;

/**
 * Begins without a key, at time 0 (requirement SGN-001).
 *
 * @param signing what is begun
 * @param link    the number that we give to our link
 * @param hash    SHA256
 */
void keel_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash);

/**
 * Sets a key (requirement SGN-002): from now on frames are signed and checked. Streams are
 * forgotten, as no frame of theirs was signed with it; our time stays. Called for somebody at the
 * vehicle, never for a message from a link.
 *
 * @param signing what the key is of
 * @param key     KEEL_SIGNING_KEY_BYTES bytes; copied
 */
void keel_signing_set_key(keel_signing_t *signing, const uint8_t *key);

/**
 * Forgets the key (requirement SGN-002): from now on frames are neither signed nor checked. Called
 * as keel_signing_set_key is.
 *
 * @param signing what the key was of
 */
void keel_signing_clear_key(keel_signing_t *signing);

/**
 * Moves our time forward (requirement SGN-003): after a restart, and by a clock that knows the
 * date.
 *
 * @param signing   whose time it is
 * @param timestamp in 10 us since 2015 began (UTC); what is not after our time, or above
 *                  KEEL_SIGNING_TIME_MAX, changes nothing
 */
void keel_signing_advance(keel_signing_t *signing, uint64_t timestamp);

/**
 * Whether a frame may be acted on (requirements SGN-004 to SGN-010). Asked once for each frame that
 * a decoder took: the second time it is a replay.
 *
 * @param signing the key
 * @param frame   what keel_mavlink_take took
 * @return whether it has a right signature and is new, or no key is set
 */
bool keel_signing_accepts(keel_signing_t *signing, const keel_mavlink_frame_t *frame);

/**
 * Writes a frame as keel_mavlink_write does, signed when a key is set (requirements SGN-011 and
 * SGN-012).
 *
 * @param signing the key
 * @param sender  as there; its is_signing becomes whether a key is set
 * @param message as there
 * @param payload as there
 * @param length  as there
 * @param packet  as there
 * @return as there; 0, too, when it is to be signed and our time is at its end
 */
uint16_t keel_signing_write(keel_signing_t *signing, keel_mavlink_sender_t *sender,
                            const keel_mavlink_message_t *message, const uint8_t *payload,
                            uint8_t length, keel_mavlink_packet_t *packet);

KEEL_C_END

#endif
