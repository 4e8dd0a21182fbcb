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
 * Only keel_signing_set_key sets the key: whoever calls that does so for somebody at the
 * vehicle (a local console), never for a message from a link.
 *
 * A frame moves a stream's time, and ours, only after its signature was found right: otherwise
 * whoever made one up could make the real sender's look old.
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

/** Bytes of a key. */
#define KEEL_SIGNING_KEY_BYTES 32

/** Bytes of a hash. */
#define KEEL_SIGNING_DIGEST_BYTES 32

/** The most streams at a time. */
#define KEEL_SIGNING_STREAMS 8

/** A minute, in 10 us: as much a new stream may be behind our time. */
#define KEEL_SIGNING_MINUTE 6000000u

/** The last time there is: it has 48 bits, which end in the year 2104. */
#define KEEL_SIGNING_TIME_MAX 0xFFFFFFFFFFFFu

/** Bytes that are hashed, at most: the key, and a frame without its last bytes, 32 + 280 - 6. */
#define KEEL_SIGNING_TEXT_MAX 306

/**
 * The SHA256 of some bytes (FIPS 180-4). It writes nothing but the digest.
 *
 * @param data   the bytes
 * @param size   how many, at most KEEL_SIGNING_TEXT_MAX
 * @param digest where it goes, KEEL_SIGNING_DIGEST_BYTES bytes
 */
typedef void (*keel_signing_hash_fn_t)(const uint8_t *data, uint32_t size, uint8_t *digest);

/* Any such function. It is only declared for the proofs; nobody defines or calls it. */
/*@ requires \valid_read(data + (0 .. size - 1)) &&
  @     \valid(digest + (0 .. KEEL_SIGNING_DIGEST_BYTES - 1)) &&
  @     \separated(data + (0 .. size - 1), digest + (0 .. KEEL_SIGNING_DIGEST_BYTES - 1));
  @ assigns digest[0 .. KEEL_SIGNING_DIGEST_BYTES - 1];
  @*/
void keel_any_hash(const uint8_t *data, uint32_t size, uint8_t *digest);

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

/*@ // No sender on a link has two streams: the time of the one would be no time of the other.
  @ predicate signing_apart(keel_signing_t *s) =
  @     \forall integer i, j; 0 <= i < j < s->streams ==>
  @         s->stream[i].system != s->stream[j].system ||
  @         s->stream[i].component != s->stream[j].component ||
  @         s->stream[i].link != s->stream[j].link;
  @
  @ // Between any two calls.
  @ predicate signing_valid(keel_signing_t *s) =
  @     s->streams <= KEEL_SIGNING_STREAMS && s->timestamp <= KEEL_SIGNING_TIME_MAX &&
  @     signing_apart(s);
  @
  @ predicate signing_hashed(keel_signing_t *s) = s->hash == &keel_any_hash;
  @
  @ predicate signing_is_of(keel_signing_stream_t *stream, keel_mavlink_frame_t *frame) =
  @     stream->system == frame->system && stream->component == frame->component &&
  @     stream->link == frame->link;
  @
  @ predicate signing_is_new(keel_signing_t *s, keel_mavlink_frame_t *frame) =
  @     \forall integer i; 0 <= i < s->streams ==> !signing_is_of(&s->stream[i], frame);
  @
  @ predicate signing_kept{L, M}(keel_signing_t *s) =
  @     \at(s->streams, M) == \at(s->streams, L) && \at(s->timestamp, M) == \at(s->timestamp, L) &&
  @     \forall integer i; 0 <= i < KEEL_SIGNING_STREAMS ==>
  @         \at(s->stream[i].timestamp, M) == \at(s->stream[i].timestamp, L) &&
  @         \at(s->stream[i].system, M) == \at(s->stream[i].system, L) &&
  @         \at(s->stream[i].component, M) == \at(s->stream[i].component, L) &&
  @         \at(s->stream[i].link, M) == \at(s->stream[i].link, L);
  @*/

/**
 * Begins without a key, at time 0 (requirement SGN-001).
 *
 * @param signing what is begun
 * @param link    the number that we give to our link
 * @param hash    SHA256
 */
/*@ requires \valid(signing);
  @ assigns *signing;
  @ ensures SGN_001_begun: signing_valid(signing) && !signing->has_key &&
  @     signing->link == link && signing->timestamp == 0 && signing->streams == 0 &&
  @     signing->hash == hash;
  @*/
void keel_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash);

/**
 * Sets a key (requirement SGN-002): from now on frames are signed and checked. Streams are
 * forgotten, as no frame of theirs was signed with it; our time stays. Called for somebody at the
 * vehicle, never for a message from a link.
 *
 * @param signing what the key is of
 * @param key     KEEL_SIGNING_KEY_BYTES bytes; copied
 */
/*@ requires \valid(signing) && signing_valid(signing) &&
  @     \valid_read(key + (0 .. KEEL_SIGNING_KEY_BYTES - 1)) &&
  @     \separated(signing, key + (0 .. KEEL_SIGNING_KEY_BYTES - 1));
  @ assigns signing->text[0 .. KEEL_SIGNING_KEY_BYTES - 1], signing->streams, signing->has_key;
  @ ensures SGN_002_valid: signing_valid(signing);
  @ ensures SGN_002_set: signing->has_key && signing->streams == 0 &&
  @     \forall integer i; 0 <= i < KEEL_SIGNING_KEY_BYTES ==> signing->text[i] == key[i];
  @*/
void keel_signing_set_key(keel_signing_t *signing, const uint8_t *key);

/**
 * Forgets the key (requirement SGN-002): from now on frames are neither signed nor checked. Called
 * as keel_signing_set_key is.
 *
 * @param signing what the key was of
 */
/*@ requires \valid(signing) && signing_valid(signing);
  @ assigns signing->text[0 .. KEEL_SIGNING_KEY_BYTES - 1], signing->streams, signing->has_key;
  @ ensures SGN_002_valid: signing_valid(signing);
  @ ensures SGN_002_cleared: !signing->has_key && signing->streams == 0 &&
  @     \forall integer i; 0 <= i < KEEL_SIGNING_KEY_BYTES ==> signing->text[i] == 0;
  @*/
void keel_signing_clear_key(keel_signing_t *signing);

/**
 * Moves our time forward (requirement SGN-003): after a restart, and by a clock that knows the
 * date.
 *
 * @param signing   whose time it is
 * @param timestamp in 10 us since 2015 began (UTC); what is not after our time, or above
 *                  KEEL_SIGNING_TIME_MAX, changes nothing
 */
/*@ requires \valid(signing) && signing_valid(signing);
  @ assigns signing->timestamp;
  @ ensures SGN_003_valid: signing_valid(signing);
  @ ensures SGN_003_later: signing->timestamp ==
  @     (\old(signing->timestamp) < timestamp <= KEEL_SIGNING_TIME_MAX ? timestamp :
  @         \old(signing->timestamp));
  @*/
void keel_signing_advance(keel_signing_t *signing, uint64_t timestamp);

/**
 * Whether a frame may be acted on (requirements SGN-004 to SGN-010). Asked once for each frame that
 * a decoder took: the second time it is a replay.
 *
 * @param signing the key
 * @param frame   what keel_mavlink_take took
 * @return whether it has a right signature and is new, or no key is set
 */
/*@ requires \valid(signing) && \valid_read(frame) && \separated(signing, frame) &&
  @     signing_valid(signing) && signing_hashed(signing) &&
  @     frame->timestamp <= KEEL_SIGNING_TIME_MAX;
  @ assigns signing->stream[0 .. KEEL_SIGNING_STREAMS - 1], signing->streams, signing->count,
  @     signing->timestamp, signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
  @ ensures SGN_003_valid: signing_valid(signing);
  @ ensures SGN_004_open: !signing->has_key ==> \result && signing_kept{Pre, Post}(signing);
  @ ensures SGN_005_missing: signing->has_key && !frame->is_signed ==> !\result;
  @ ensures SGN_006_replayed: signing->has_key ==>
  @     \forall integer i; 0 <= i < \old(signing->streams) &&
  @         \old(signing_is_of(&signing->stream[i], frame)) &&
  @         frame->timestamp <= \old(signing->stream[i].timestamp) ==> !\result;
  @ ensures SGN_007_old: signing->has_key && \old(signing_is_new(signing, frame)) &&
  @     frame->timestamp + KEEL_SIGNING_MINUTE < \old(signing->timestamp) ==> !\result;
  @ ensures SGN_007_full: signing->has_key && \old(signing_is_new(signing, frame)) &&
  @     \old(signing->streams) == KEEL_SIGNING_STREAMS ==> !\result;
  @ ensures SGN_009_kept: !\result ==> signing_kept{Pre, Post}(signing);
  @ ensures SGN_010_time: signing->timestamp ==
  @     (\result && signing->has_key && frame->timestamp > \old(signing->timestamp) ?
  @         frame->timestamp : \old(signing->timestamp));
  @ ensures SGN_010_forward: signing->streams >= \old(signing->streams) &&
  @     \forall integer i; 0 <= i < \old(signing->streams) ==>
  @         signing->stream[i].timestamp >= \old(signing->stream[i].timestamp) &&
  @         signing->stream[i].system == \old(signing->stream[i].system) &&
  @         signing->stream[i].component == \old(signing->stream[i].component) &&
  @         signing->stream[i].link == \old(signing->stream[i].link);
  @*/
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
/*@ requires \valid(signing) && signing_valid(signing) && signing_hashed(signing);
  @ requires \valid(sender) && \valid_read(message) && \valid_read(payload + (0 .. length - 1)) &&
  @     \valid(packet) &&
  @     \separated(signing, sender, message, payload + (0 .. length - 1), packet);
  @ assigns signing->timestamp,
  @     signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1], sender->is_signing,
  @     sender->sequence, packet->bytes[0 .. KEEL_MAVLINK_FRAME_MAX - 1];
  @ ensures SGN_011_flag: \result > 0 ==> packet->bytes[2] == (signing->has_key != 0 ? 1 : 0);
  @ ensures SGN_011_link: \result > 0 && signing->has_key != 0 ==>
  @     packet->bytes[\result - KEEL_MAVLINK_SIGNATURE_BYTES] == signing->link;
  @ ensures SGN_012_valid: signing_valid(signing);
  @ ensures SGN_012_time: signing->timestamp ==
  @     \old(signing->timestamp) + (\result > 0 && signing->has_key ? 1 : 0);
  @ ensures SGN_012_end: signing->has_key && \old(signing->timestamp) == KEEL_SIGNING_TIME_MAX ==>
  @     \result == 0;
  @*/
uint16_t keel_signing_write(keel_signing_t *signing, keel_mavlink_sender_t *sender,
                            const keel_mavlink_message_t *message, const uint8_t *payload,
                            uint8_t length, keel_mavlink_packet_t *packet);

KEEL_C_END

#endif
