/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/signing.h"

#define BYTE            0xFFu
#define BITS            8u
#define TIMESTAMP_BYTES 6u

/* Where what is hashed of a frame begins, and its payload. */
#define FRAME_AT   ((uint32_t)KEEL_SIGNING_KEY_BYTES)
#define PAYLOAD_AT (FRAME_AT + (uint32_t)KEEL_MAVLINK_HEADER_BYTES)

/* Bytes of a frame without its seal, at most. */
#define SIGNED_MAX ((uint32_t)KEEL_MAVLINK_FRAME_MAX - (uint32_t)KEEL_MAVLINK_SEAL_BYTES)

/* From a signature's first byte on. */
#define TIMESTAMP_AT 1u
#define SEAL_AT      7u

/*@ requires \valid(count);
  @ assigns *count;
  @ ensures *count == mavlink_sum(\old(*count));
  @*/
static void count_signed(uint32_t *count)
{
    *count += (*count < UINT32_MAX) ? 1u : 0u;
}

/* A byte of a number, the lowest first. */
/*@ requires place < TIMESTAMP_BYTES;
  @ assigns \nothing;
  @*/
static uint8_t byte_in(uint64_t number, uint32_t place)
{
    const uint32_t bits = BITS * place;

    return (uint8_t)((number >> bits) & BYTE);
}

/* The place of the frame's stream; the number of streams when it has none. */
/*@ requires \valid_read(signing) && \valid_read(frame) && signing_valid(signing);
  @ assigns \nothing;
  @ ensures \result <= signing->streams;
  @ ensures \result < signing->streams ==> signing_is_of(&signing->stream[\result], frame);
  @ ensures \forall integer i; 0 <= i < \result ==> !signing_is_of(&signing->stream[i], frame);
  @*/
static uint32_t place_of_stream(const keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    uint32_t place = 0u;

    /*@ loop invariant 0 <= place <= signing->streams;
      @ loop invariant \forall integer i; 0 <= i < place ==>
      @     !signing_is_of(&signing->stream[i], frame);
      @ loop assigns place;
      @ loop variant signing->streams - place;
      @*/
    while ((place < signing->streams) && ((signing->stream[place].system != frame->system) ||
                                          (signing->stream[place].component != frame->component) ||
                                          (signing->stream[place].link != frame->link))) {
        place++;
    }
    return place;
}

/* Whether it is newer than what came before it, or why not. */
/*@ requires \valid(signing) && \valid_read(frame) && \separated(signing, frame);
  @ requires signing_valid(signing) && frame->timestamp <= KEEL_SIGNING_TIME_MAX;
  @ requires place <= signing->streams;
  @ assigns signing->count.replayed, signing->count.full, signing->count.old;
  @ ensures \result && place < signing->streams ==>
  @     frame->timestamp > signing->stream[place].timestamp;
  @ ensures \result && place == signing->streams ==> place < KEEL_SIGNING_STREAMS &&
  @     frame->timestamp + KEEL_SIGNING_MINUTE >= signing->timestamp;
  @*/
static bool is_fresh(keel_signing_t *signing, const keel_mavlink_frame_t *frame, uint32_t place)
{
    bool fresh = false;

    if (place < signing->streams) {
        fresh = frame->timestamp > signing->stream[place].timestamp;
        if (!fresh) {
            count_signed(&signing->count.replayed);
        }
    } else if (place == (uint32_t)KEEL_SIGNING_STREAMS) {
        count_signed(&signing->count.full);
    } else if ((frame->timestamp + KEEL_SIGNING_MINUTE) < signing->timestamp) {
        count_signed(&signing->count.old);
    } else {
        fresh = true;
    }
    return fresh;
}

/* Puts the frame behind the key, as it was sent and without its seal. All of the payload is copied,
 * and what follows it put over the rest: the same work for any frame. */
/*@ requires \valid(signing) && \valid_read(frame) && \separated(signing, frame);
  @ assigns signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
  @ ensures KEEL_SIGNING_KEY_BYTES <= \result <= KEEL_SIGNING_TEXT_MAX;
  @*/
static uint32_t put_frame(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    const uint8_t header[KEEL_MAVLINK_HEADER_BYTES] = {
        (uint8_t)KEEL_MAVLINK_FIRST,
        frame->length,
        1u, /* The flag of a signature. */
        frame->compatible,
        frame->sequence,
        frame->system,
        frame->component,
        byte_in(frame->id, 0u),
        byte_in(frame->id, 1u),
        byte_in(frame->id, 2u),
    };
    const uint32_t end = PAYLOAD_AT + (uint32_t)frame->length;

    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_HEADER_BYTES;
      @ loop assigns i, signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
      @ loop variant KEEL_MAVLINK_HEADER_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_HEADER_BYTES; i++) {
        signing->text[FRAME_AT + i] = header[i];
    }
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_PAYLOAD_MAX;
      @ loop assigns i, signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
      @ loop variant KEEL_MAVLINK_PAYLOAD_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_PAYLOAD_MAX; i++) {
        signing->text[PAYLOAD_AT + i] = frame->payload[i];
    }
    signing->text[end] = byte_in(frame->checksum, 0u);
    signing->text[end + 1u] = byte_in(frame->checksum, 1u);
    signing->text[end + 2u] = frame->link;
    /*@ loop invariant 0 <= i <= TIMESTAMP_BYTES;
      @ loop assigns i, signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
      @ loop variant TIMESTAMP_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < TIMESTAMP_BYTES; i++) {
        signing->text[end + 3u + i] = byte_in(frame->timestamp, i);
    }
    return end + 3u + TIMESTAMP_BYTES;
}

/* Whether its seal is right. How long this takes tells nothing of how much of it is. */
/*@ requires \valid(signing) && \valid_read(frame) && \separated(signing, frame);
  @ requires signing_hashed(signing);
  @ assigns signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1],
  @     signing->count.wrong;
  @*/
static bool is_sealed(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    uint8_t digest[KEEL_SIGNING_DIGEST_BYTES] = {0};
    const uint32_t size = put_frame(signing, frame);
    uint32_t difference = 0u;

    //@ calls keel_any_hash;
    signing->hash(signing->text, size, digest);
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_SEAL_BYTES;
      @ loop assigns i, difference;
      @ loop variant KEEL_MAVLINK_SEAL_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_SEAL_BYTES; i++) {
        difference |= (uint32_t)digest[i] ^ (uint32_t)frame->seal[i];
    }
    if (difference != 0u) {
        count_signed(&signing->count.wrong);
    }
    return difference == 0u;
}

/* Moves its stream's time to the frame's, and ours up to it. */
/*@ requires \valid(signing) && \valid_read(frame) && \separated(signing, frame);
  @ requires signing_valid(signing) && frame->timestamp <= KEEL_SIGNING_TIME_MAX;
  @ requires place <= signing->streams && place < KEEL_SIGNING_STREAMS;
  @ requires place < signing->streams ==>
  @     signing_is_of(&signing->stream[place], frame) &&
  @     frame->timestamp > signing->stream[place].timestamp;
  @ requires place == signing->streams ==> signing_is_new(signing, frame);
  @ assigns signing->stream[place], signing->streams, signing->count.accepted, signing->timestamp;
  @ ensures signing_valid(signing);
  @ ensures signing->streams == \old(signing->streams) + (place == \old(signing->streams) ? 1 : 0);
  @ ensures signing_is_of(&signing->stream[place], frame) &&
  @     signing->stream[place].timestamp == frame->timestamp;
  @ ensures signing->timestamp == (frame->timestamp > \old(signing->timestamp) ?
  @     frame->timestamp : \old(signing->timestamp));
  @*/
static void note_frame(keel_signing_t *signing, const keel_mavlink_frame_t *frame, uint32_t place)
{
    keel_signing_stream_t *const stream = &signing->stream[place];

    stream->timestamp = frame->timestamp;
    stream->system = frame->system;
    stream->component = frame->component;
    stream->link = frame->link;
    if (place == signing->streams) {
        signing->streams++;
    }
    if (frame->timestamp > signing->timestamp) {
        signing->timestamp = frame->timestamp;
    }
    count_signed(&signing->count.accepted);
}

void keel_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash)
{
    static const keel_signing_count_t no_count = {0};
    static const keel_signing_stream_t no_stream = {0};

    /*@ loop invariant 0 <= i <= KEEL_SIGNING_STREAMS;
      @ loop assigns i, signing->stream[0 .. KEEL_SIGNING_STREAMS - 1];
      @ loop variant KEEL_SIGNING_STREAMS - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SIGNING_STREAMS; i++) {
        signing->stream[i] = no_stream;
    }
    /*@ loop invariant 0 <= i <= KEEL_SIGNING_TEXT_MAX;
      @ loop assigns i, signing->text[0 .. KEEL_SIGNING_TEXT_MAX - 1];
      @ loop variant KEEL_SIGNING_TEXT_MAX - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SIGNING_TEXT_MAX; i++) {
        signing->text[i] = 0u;
    }
    signing->count = no_count;
    signing->streams = 0u;
    signing->timestamp = 0u;
    signing->link = link;
    signing->hash = hash;
    signing->has_key = false;
}

void keel_signing_set_key(keel_signing_t *signing, const uint8_t *key)
{
    /*@ loop invariant 0 <= i <= KEEL_SIGNING_KEY_BYTES;
      @ loop invariant \forall integer j; 0 <= j < i ==> signing->text[j] == key[j];
      @ loop assigns i, signing->text[0 .. KEEL_SIGNING_KEY_BYTES - 1];
      @ loop variant KEEL_SIGNING_KEY_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_SIGNING_KEY_BYTES; i++) {
        signing->text[i] = key[i];
    }
    signing->streams = 0u;
    signing->has_key = true;
}

void keel_signing_clear_key(keel_signing_t *signing)
{
    const uint8_t no_key[KEEL_SIGNING_KEY_BYTES] = {0};

    keel_signing_set_key(signing, no_key);
    signing->has_key = false;
}

void keel_signing_advance(keel_signing_t *signing, uint64_t timestamp)
{
    if ((timestamp > signing->timestamp) && (timestamp <= KEEL_SIGNING_TIME_MAX)) {
        signing->timestamp = timestamp;
    }
}

bool keel_signing_accepts(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    bool accepted = false;

    if (!signing->has_key) {
        accepted = true;
    } else if (!frame->is_signed) {
        count_signed(&signing->count.missing);
    } else {
        const uint32_t place = place_of_stream(signing, frame);

        if (is_fresh(signing, frame, place)) {
            accepted = is_sealed(signing, frame);
            if (accepted) {
                note_frame(signing, frame, place);
            }
        }
    }
    return accepted;
}

/* Signs a frame that has room for it, with the time that follows ours. Behind the key goes as much
 * as a frame may have, and of that as much is hashed as this one has. */
/*@ requires \valid(signing) && signing_valid(signing) && signing_hashed(signing) &&
  @     signing->timestamp < KEEL_SIGNING_TIME_MAX;
  @ requires KEEL_MAVLINK_HEADER_BYTES + KEEL_MAVLINK_SIGNATURE_BYTES < whole;
  @ requires whole <= KEEL_MAVLINK_FRAME_MAX;
  @ requires \valid(packet) && \separated(signing, packet);
  @ assigns signing->timestamp,
  @     signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1],
  @     packet->bytes[whole - KEEL_MAVLINK_SIGNATURE_BYTES .. whole - 1];
  @ ensures signing_valid(signing);
  @ ensures signing->timestamp == \old(signing->timestamp) + 1;
  @ ensures packet->bytes[whole - KEEL_MAVLINK_SIGNATURE_BYTES] == signing->link;
  @*/
static void sign_frame(keel_signing_t *signing, keel_mavlink_packet_t *packet, uint32_t whole)
{
    uint8_t digest[KEEL_SIGNING_DIGEST_BYTES] = {0};
    const uint32_t at = whole - (uint32_t)KEEL_MAVLINK_SIGNATURE_BYTES;
    const uint32_t seal = at + SEAL_AT;

    signing->timestamp++;
    packet->bytes[at] = signing->link;
    /*@ loop invariant 0 <= i <= TIMESTAMP_BYTES;
      @ loop assigns i, packet->bytes[at + 1 .. seal - 1];
      @ loop variant TIMESTAMP_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < TIMESTAMP_BYTES; i++) {
        packet->bytes[at + TIMESTAMP_AT + i] = byte_in(signing->timestamp, i);
    }
    /*@ loop invariant 0 <= i <= SIGNED_MAX;
      @ loop assigns i, signing->text[KEEL_SIGNING_KEY_BYTES .. KEEL_SIGNING_TEXT_MAX - 1];
      @ loop variant SIGNED_MAX - i;
      @*/
    for (uint32_t i = 0u; i < SIGNED_MAX; i++) {
        signing->text[FRAME_AT + i] = packet->bytes[i];
    }
    //@ calls keel_any_hash;
    signing->hash(signing->text, FRAME_AT + seal, digest);
    /*@ loop invariant 0 <= i <= KEEL_MAVLINK_SEAL_BYTES;
      @ loop assigns i, packet->bytes[seal .. whole - 1];
      @ loop variant KEEL_MAVLINK_SEAL_BYTES - i;
      @*/
    for (uint32_t i = 0u; i < (uint32_t)KEEL_MAVLINK_SEAL_BYTES; i++) {
        packet->bytes[seal + i] = digest[i];
    }
}

uint16_t keel_signing_write(keel_signing_t *signing, keel_mavlink_sender_t *sender,
                            const keel_mavlink_message_t *message, const uint8_t *payload,
                            uint8_t length, keel_mavlink_packet_t *packet)
{
    uint16_t whole = 0u;

    sender->is_signing = signing->has_key;
    if (!signing->has_key || (signing->timestamp < KEEL_SIGNING_TIME_MAX)) {
        whole = keel_mavlink_write(sender, message, payload, length, packet);
        if (signing->has_key && (whole > 0u)) {
            sign_frame(signing, packet, whole);
        }
    }
    return whole;
}
