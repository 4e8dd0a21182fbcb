/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_mavlink.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of MAVLink's frames and to its
 *        model; they never differ, and what was taken, written again, is what came; and of a frame
 *        behind a gap MAVLink's own parser thinks the same.
 *
 *     make check NAME=fuzz ARGS="--filter mavlink"
 *
 * The first byte chooses how many messages are known; 0xA5 0x5A is a gap. Checksums of messages
 * that are known are made right for every other frame, as few would be by chance.
 */
#include "../../specs/model/mavlink.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KNOWN 4u

static const keel_mavlink_message_t messages[KNOWN] = {
    {.id = 0u, .crc_extra = 50u, .shortest = 1u, .longest = 9u},
    {.id = 30u, .crc_extra = 39u, .shortest = 20u, .longest = 28u},
    {.id = 253u, .crc_extra = 83u, .shortest = 0u, .longest = 255u},
    {.id = 300u, .crc_extra = 217u, .shortest = 1u, .longest = 255u},
};

/* How long HEARTBEAT, ATTITUDE and STATUSTEXT are at most, and bytes that make up a frame. */
static const uint8_t defined[3] = {9u, 28u, 54u};
#define JUDGED 64u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static keel_mavlink_t mavlink;
static keel_mavlink_t model;

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The byte of the right checksum that is due, or the one that came. */
static uint8_t repaired(uint8_t byte)
{
    const uint8_t *const frame = mavlink.bytes;
    const uint32_t end = 10u + (uint32_t)frame[1];
    uint16_t checksum = KEEL_CRC16_FIRST;

    if ((mavlink.awaited == 10u) || (mavlink.held < end) || ((frame[4] & 1u) != 0u)) {
        return byte;
    }
    for (uint32_t i = 1u; i < end; i++) {
        checksum = keel_crc16(checksum, frame[i]);
    }
    checksum = keel_crc16(checksum, messages[mavlink.message].crc_extra);
    if (mavlink.held == end) {
        return (uint8_t)(checksum & 0xFFu);
    }
    return (mavlink.held == (end + 1u)) ? (uint8_t)(checksum >> 8) : byte;
}

/* The frame that was found, and the bytes that it came in. */
static void write_again(const uint8_t *came, uint32_t whole)
{
    const keel_mavlink_frame_t *frame = &mavlink.frame;
    keel_mavlink_sender_t sender = {.system = frame->system,
                                    .component = frame->component,
                                    .sequence = frame->sequence,
                                    .is_signing = frame->is_signed};
    keel_mavlink_packet_t packet;
    const uint8_t *const out = packet.bytes;
    const uint16_t written = keel_mavlink_write(&sender, &messages[mavlink.message], frame->payload,
                                                frame->length, &packet);
    const bool cut = (frame->length > 1u) && (frame->payload[frame->length - 1u] == 0u);

    if ((frame->length > 0u) && !cut && (frame->compatible == 0u)) {
        if ((written != whole) || (memcmp(out, came, frame->length + 12u) != 0)) {
            differs("what is written is not what came");
        }
    }
}

/* One look of each, or what both do at a gap; what is found, written again, is what came. */
static keel_mavlink_look_t both_look(bool is_gap)
{
    const keel_mavlink_t before = mavlink;
    const keel_mavlink_look_t seen = is_gap ? keel_mavlink_gap(&mavlink)
                                            : keel_mavlink_look(&mavlink);

    if (ALONE) {
        return seen;
    }
    if (seen != (is_gap ? model_mavlink_gap(&model) : model_mavlink_look(&model))) {
        differs("what a look finds");
    }
    if (memcmp(&mavlink, &model, sizeof mavlink) != 0) {
        differs("a field");
    }
    if (seen == KEEL_MAVLINK_FRAME) {
        write_again(before.bytes, before.awaited);
    }
    return seen;
}

/* Looks until nothing is found; how many frames were. */
static uint32_t both_search(bool is_gap)
{
    const uint32_t most = 2u * mavlink.held;
    uint32_t frames = 0u;
    keel_mavlink_look_t seen = both_look(is_gap);

    for (uint32_t looks = 1u; seen != KEEL_MAVLINK_NOTHING; looks++) {
        if (looks > most) {
            differs("looks are more than twice the bytes");
        }
        frames += (seen == KEEL_MAVLINK_FRAME) ? 1u : 0u;
        seen = both_look(is_gap);
    }
    return frames;
}

static uint32_t both_take(uint8_t byte)
{
    const keel_status_t status = keel_mavlink_take(&mavlink, byte);

    if (!ALONE && ((status != KEEL_OK) || (model_mavlink_take(&model, byte) != KEEL_OK))) {
        differs("whether there is room behind a look");
    }
    return both_search(false);
}

/* Whether MAVLink's parser and ours read the same; of zeros at the end ours tells none. */
static bool is_same(const oracle_mavlink_t *said)
{
    const keel_mavlink_frame_t *const frame = &mavlink.frame;

    return (frame->id == said->id) && (frame->sequence == said->sequence) &&
           (frame->system == said->system) && (frame->component == said->component) &&
           (frame->length == said->length) &&
           (memcmp(frame->payload, said->payload, frame->length) == 0);
}

/* A frame behind a gap, of a message that both know, and not longer than it is defined: taken when
 * MAVLink's parser takes it, and not else. The first byte is its sequence number. */
static void judge_frame(const uint8_t *bytes)
{
    const keel_mavlink_message_t *const message = &messages[bytes[0] % 3u];
    const uint32_t shortest = message->shortest;
    const uint8_t length = (uint8_t)(shortest + (bytes[1] % (defined[bytes[0] % 3u] - shortest)));
    uint8_t frame[KEEL_MAVLINK_FRAME_MAX] = {KEEL_MAVLINK_FIRST,
                                             length,
                                             0u,
                                             bytes[2],
                                             bytes[3],
                                             bytes[4],
                                             bytes[5],
                                             (uint8_t)(message->id & 0xFFu),
                                             (uint8_t)(message->id >> 8),
                                             0u};
    oracle_mavlink_t said;
    uint32_t refused;
    bool taken = false;

    (void)both_search(true);
    refused = mavlink.count.checksums;
    for (uint32_t i = 0u; i < (length + 12u); i++) {
        frame[i] = (i < 10u) ? frame[i] : repaired(bytes[i - 4u]);
        taken = (both_take(frame[i]) > 0u) && (mavlink.count.checksums == refused);
    }
    if (taken != oracle_mavlink(frame, length + 12u, &said)) {
        differs("whether MAVLink's parser takes a frame");
    }
    if (taken && !is_same(&said)) {
        differs("what MAVLink's parser reads");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint32_t known = (size > 0u) ? (data[0] % (KNOWN + 1u)) : 0u;

    memset(&mavlink, 0, sizeof mavlink);
    memset(&model, 0, sizeof model);
    (void)keel_mavlink_init(&mavlink, messages, known);
    (void)model_mavlink_init(&model, messages, known);
    for (size_t i = 1u; (i < size) && !ALONE; i++) {
        (void)both_take(repaired(data[i]));
        if ((data[i] == 0x5Au) && (data[i - 1u] == 0xA5u)) {
            (void)both_search(true);
        }
    }
    if ((known == KNOWN) && (size >= JUDGED)) {
        judge_frame(&data[size - JUDGED]);
    }
    return 0;
}
