/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/signing.h
 * @brief The contracts of signing.h, as the provers read them.
 *
 * A frame moves a stream's time, and ours, only after its signature was found right: otherwise
 * whoever made one up could make the real sender's look old.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_SIGNING_H
#define KEEL_INTERNAL_MIDDLEWARE_SIGNING_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/mavlink.h"
#include "keel/middleware/signing.h"

KEEL_C_BEGIN

/* Any such function. It is only declared for the proofs; nobody defines or calls it. */
/*@ requires \valid_read(data + (0 .. size - 1)) &&
  @     \valid(digest + (0 .. KEEL_SIGNING_DIGEST_BYTES - 1)) &&
  @     \separated(data + (0 .. size - 1), digest + (0 .. KEEL_SIGNING_DIGEST_BYTES - 1));
  @ assigns digest[0 .. KEEL_SIGNING_DIGEST_BYTES - 1];
  @*/
void keel_any_hash(const uint8_t *data, uint32_t size, uint8_t *digest);

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

/*@ requires \valid(signing);
  @ assigns *signing;
  @ ensures SGN_001_begun: signing_valid(signing) && !signing->has_key &&
  @     signing->link == link && signing->timestamp == 0 && signing->streams == 0 &&
  @     signing->hash == hash;
  @*/
void keel_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash);

/*@ requires \valid(signing) && signing_valid(signing) &&
  @     \valid_read(key + (0 .. KEEL_SIGNING_KEY_BYTES - 1)) &&
  @     \separated(signing, key + (0 .. KEEL_SIGNING_KEY_BYTES - 1));
  @ assigns signing->text[0 .. KEEL_SIGNING_KEY_BYTES - 1], signing->streams, signing->has_key;
  @ ensures SGN_002_valid: signing_valid(signing);
  @ ensures SGN_002_set: signing->has_key && signing->streams == 0 &&
  @     \forall integer i; 0 <= i < KEEL_SIGNING_KEY_BYTES ==> signing->text[i] == key[i];
  @*/
void keel_signing_set_key(keel_signing_t *signing, const uint8_t *key);

/*@ requires \valid(signing) && signing_valid(signing);
  @ assigns signing->text[0 .. KEEL_SIGNING_KEY_BYTES - 1], signing->streams, signing->has_key;
  @ ensures SGN_002_valid: signing_valid(signing);
  @ ensures SGN_002_cleared: !signing->has_key && signing->streams == 0 &&
  @     \forall integer i; 0 <= i < KEEL_SIGNING_KEY_BYTES ==> signing->text[i] == 0;
  @*/
void keel_signing_clear_key(keel_signing_t *signing);

/*@ requires \valid(signing) && signing_valid(signing);
  @ assigns signing->timestamp;
  @ ensures SGN_003_valid: signing_valid(signing);
  @ ensures SGN_003_later: signing->timestamp ==
  @     (\old(signing->timestamp) < timestamp <= KEEL_SIGNING_TIME_MAX ? timestamp :
  @         \old(signing->timestamp));
  @*/
void keel_signing_advance(keel_signing_t *signing, uint64_t timestamp);

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
