/* SPDX-License-Identifier: Apache-2.0 */
#include "signing.h"

#include "mavlink.h"

/* SGN-001 */
void model_signing_init(keel_signing_t *signing, uint8_t link, keel_signing_hash_fn_t hash)
{
    static const keel_signing_t nothing = {0};

    *signing = nothing;
    signing->link = link;
    signing->hash = hash;
}

/* SGN-002 */
void model_signing_set_key(keel_signing_t *signing, const uint8_t *key)
{
    for (uint32_t i = 0u; i < 32u; i++) {
        signing->text[i] = key[i];
    }
    signing->has_key = true;
    signing->streams = 0u;
}

/* SGN-002 */
void model_signing_clear_key(keel_signing_t *signing)
{
    for (uint32_t i = 0u; i < 32u; i++) {
        signing->text[i] = 0u;
    }
    signing->has_key = false;
    signing->streams = 0u;
}

/* SGN-003 */
void model_signing_advance(keel_signing_t *signing, uint64_t timestamp)
{
    if ((timestamp >> 48u) != 0u) {
        return;
    }
    if (timestamp >= signing->timestamp) {
        signing->timestamp = timestamp;
    }
}

/* Counts stay at their end. */
static void note_one(uint32_t *count)
{
    if (*count != UINT32_MAX) {
        *count = *count + 1u;
    }
}

/* The byte of a number at this place, the lowest first. */
static uint8_t byte_of(uint64_t value, uint32_t place)
{
    return (uint8_t)((value >> (8u * place)) & 0xFFu);
}

/* SGN-008: header, payload and checksum as they were sent, link and timestamp. */
static uint32_t put_signed(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    const uint8_t header[10] = {0xFDu,
                                frame->length,
                                0x01u,
                                frame->compatible,
                                frame->sequence,
                                frame->system,
                                frame->component,
                                byte_of(frame->id, 0u),
                                byte_of(frame->id, 1u),
                                byte_of(frame->id, 2u)};
    const uint8_t tail[9] = {byte_of(frame->checksum, 0u),
                             byte_of(frame->checksum, 1u),
                             frame->link,
                             byte_of(frame->timestamp, 0u),
                             byte_of(frame->timestamp, 1u),
                             byte_of(frame->timestamp, 2u),
                             byte_of(frame->timestamp, 3u),
                             byte_of(frame->timestamp, 4u),
                             byte_of(frame->timestamp, 5u)};
    const uint32_t end = 42u + (uint32_t)frame->length;

    for (uint32_t i = 0u; i < 10u; i++) {
        signing->text[32u + i] = header[i];
    }
    for (uint32_t i = 0u; i < 255u; i++) {
        signing->text[42u + i] = frame->payload[i];
    }
    for (uint32_t i = 0u; i < 9u; i++) {
        signing->text[end + i] = tail[i];
    }
    return end + 9u;
}

/* SGN-006, SGN-007: whether a frame is as new as it has to be; if not, why. */
static bool new_enough(keel_signing_t *signing, const keel_mavlink_frame_t *frame, uint32_t *place)
{
    *place = signing->streams;
    for (uint32_t i = 0u; i < signing->streams; i++) {
        const keel_signing_stream_t *stream = &signing->stream[i];

        if ((stream->system == frame->system) && (stream->component == frame->component) &&
            (stream->link == frame->link)) {
            *place = i;
            if (stream->timestamp >= frame->timestamp) {
                note_one(&signing->count.replayed);
                return false;
            }
            return true;
        }
    }
    if (signing->streams >= 8u) {
        note_one(&signing->count.full);
        return false;
    }
    if ((signing->timestamp > frame->timestamp) &&
        ((signing->timestamp - frame->timestamp) > 6000000u)) {
        note_one(&signing->count.old);
        return false;
    }
    return true;
}

/* SGN-008: the first six bytes of the hash are those of the frame. */
static bool rightly_signed(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    const uint32_t size = put_signed(signing, frame);
    uint8_t digest[32];

    signing->hash(signing->text, size, digest);
    for (uint32_t i = 0u; i < 6u; i++) {
        if (digest[i] != frame->seal[i]) {
            note_one(&signing->count.wrong);
            return false;
        }
    }
    return true;
}

/* SGN-004 to SGN-010 */
bool model_signing_accepts(keel_signing_t *signing, const keel_mavlink_frame_t *frame)
{
    const keel_signing_stream_t now = {.timestamp = frame->timestamp,
                                       .system = frame->system,
                                       .component = frame->component,
                                       .link = frame->link};
    uint32_t place;

    if (!signing->has_key) {
        return true;
    }
    if (!frame->is_signed) {
        note_one(&signing->count.missing);
        return false;
    }
    if (!new_enough(signing, frame, &place) || !rightly_signed(signing, frame)) {
        return false;
    }
    signing->stream[place] = now;
    if (place >= signing->streams) {
        signing->streams = place + 1u;
    }
    if (signing->timestamp < frame->timestamp) {
        signing->timestamp = frame->timestamp;
    }
    note_one(&signing->count.accepted);
    return true;
}

/* SGN-011, SGN-012 */
uint16_t model_signing_write(keel_signing_t *signing, keel_mavlink_sender_t *sender,
                             const keel_mavlink_message_t *message, const uint8_t *payload,
                             uint8_t length, keel_mavlink_packet_t *packet)
{
    uint8_t digest[32];
    uint32_t at;
    uint16_t whole;

    sender->is_signing = signing->has_key;
    if (signing->has_key && (signing->timestamp >= 0xFFFFFFFFFFFFu)) {
        return 0u;
    }
    whole = model_mavlink_write(sender, message, payload, length, packet);
    if ((whole == 0u) || !signing->has_key) {
        return whole;
    }
    at = whole - 13u;
    signing->timestamp = signing->timestamp + 1u;
    packet->bytes[at] = signing->link;
    for (uint32_t i = 0u; i < 6u; i++) {
        packet->bytes[at + 1u + i] = byte_of(signing->timestamp, i);
    }
    for (uint32_t i = 0u; i < 274u; i++) {
        signing->text[32u + i] = packet->bytes[i];
    }
    signing->hash(signing->text, 32u + (at + 7u), digest);
    for (uint32_t i = 0u; i < 6u; i++) {
        packet->bytes[at + 7u + i] = digest[i];
    }
    return whole;
}
