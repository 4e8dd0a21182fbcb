/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_mavlink.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of MAVLink's frames and to its
 *        model; they never differ, and what was taken, written again, is what came.
 *
 *     python3 tools/run_tests.py --filter fuzz_mavlink --fuzz 60
 *
 * The first byte chooses how many messages are known; 0xA5 0x5A is a gap. Checksums of messages
 * that are known are made right for every other frame, as few would be by chance.
 */
#include "../../specs/model/mavlink.h"

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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The byte of the right checksum that is due, or the one that came. */
static uint8_t repaired(const keel_mavlink_t *mavlink, uint8_t byte)
{
    const uint32_t end = 10u + (uint32_t)mavlink->header[1];
    uint16_t checksum;

    if ((mavlink->held < 10u) || (mavlink->held < end) || (mavlink->message >= mavlink->known) ||
        ((mavlink->header[4] & 1u) != 0u)) {
        return byte;
    }
    checksum = keel_crc16(mavlink->crc, messages[mavlink->message].crc_extra);
    if (mavlink->held == end) {
        return (uint8_t)(checksum & 0xFFu);
    }
    return (mavlink->held == (end + 1u)) ? (uint8_t)(checksum >> 8) : byte;
}

static void write_again(const keel_mavlink_t *mavlink, uint32_t whole)
{
    const keel_mavlink_frame_t *frame = &mavlink->frame;
    keel_mavlink_sender_t sender = {.system = frame->system,
                                    .component = frame->component,
                                    .sequence = frame->sequence,
                                    .is_signing = frame->is_signed};
    uint8_t out[KEEL_MAVLINK_FRAME_MAX];
    const uint16_t written = keel_mavlink_write(&sender, &messages[mavlink->message],
                                                frame->payload, frame->length, out, sizeof out);
    const bool cut = (frame->length > 1u) && (frame->payload[frame->length - 1u] == 0u);

    if ((frame->length > 0u) && !cut && (frame->compatible == 0u)) {
        if ((written != whole) || (memcmp(out, mavlink->header, 10u) != 0) ||
            (memcmp(&out[10], mavlink->payload, frame->length) != 0) ||
            (memcmp(&out[10u + frame->length], mavlink->tail, 2u) != 0)) {
            differs("what is written is not what came");
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static keel_mavlink_t mavlink;
    static keel_mavlink_t model;
    const uint32_t known = (size > 0u) ? (data[0] % (KNOWN + 1u)) : 0u;

    memset(&mavlink, 0, sizeof mavlink);
    memset(&model, 0, sizeof model);
    (void)keel_mavlink_init(&mavlink, messages, known);
    (void)model_mavlink_init(&model, messages, known);
    for (size_t i = 1u; i < size; i++) {
        const uint8_t byte = repaired(&model, data[i]);
        const uint32_t whole = model.held + 1u;
        const bool expected = model_mavlink_take(&model, byte);

        if (keel_mavlink_take(&mavlink, byte) != expected) {
            differs("whether a frame ends");
        }
        if (expected) {
            write_again(&mavlink, whole);
        }
        if ((data[i] == 0x5Au) && (data[i - 1u] == 0xA5u)) {
            keel_mavlink_gap(&mavlink);
            model_mavlink_gap(&model);
        }
        if (memcmp(&mavlink, &model, sizeof mavlink) != 0) {
            differs("a field");
        }
    }
    return 0;
}
