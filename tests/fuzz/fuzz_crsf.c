/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_crsf.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of CRSF and to its model; they
 *        never differ, and of a frame behind a gap another decoder, crsf, thinks the same.
 *
 *     make check NAME=fuzz ARGS="--filter crsf"
 *
 * 0xA5 0x5A is a gap. CRCs are made right for every other frame, as few would be by chance.
 */
#include "../../specs/model/crsf.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTE_US   24u
#define SILENT_US 3000u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static keel_crsf_t crsf;
static keel_crsf_t model;

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The right CRC where one is due, or the byte that came. */
static uint8_t repaired(uint8_t byte)
{
    const uint8_t *const frame = crsf.framing.byte;
    const uint32_t held = crsf.framing.held;

    if ((held < 3u) || (held != (frame[1] + 1u)) || ((frame[2] & 1u) != 0u)) {
        return byte;
    }
    return model_crsf_crc(&frame[2], held - 2u);
}

static keel_crsf_taken_t both_take(uint8_t byte, uint32_t elapsed_us)
{
    const keel_crsf_taken_t taken = keel_crsf_take(&crsf, byte, elapsed_us);

    if (ALONE) {
        return taken;
    }
    if (model_crsf_take(&model, byte, elapsed_us) != taken) {
        differs("what a byte ends");
    }
    if (memcmp(&crsf, &model, sizeof crsf) != 0) {
        differs("a field");
    }
    if (keel_crsf_is_lost(&crsf) != model_crsf_is_lost(&model)) {
        differs("whether the radio is lost");
    }
    return taken;
}

/* Channels 172, 1811, and 992 fourteen times. */
static void take_right_frame(void)
{
    static const uint8_t frame[26] = {0xC8, 0x18, 0x16, 0xAC, 0x98, 0x38, 0xF8, 0xC0, 0x07,
                                      0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0xE0, 0x03, 0x1F, 0xF8,
                                      0xC0, 0x07, 0x3E, 0xF0, 0x81, 0x0F, 0x7C, 0x20};

    for (uint32_t i = 0u; i < 25u; i++) {
        (void)both_take(frame[i], (i == 0u) ? SILENT_US : BYTE_US);
    }
    if ((both_take(frame[25], BYTE_US) != KEEL_CRSF_TOOK_CHANNELS) || (crsf.channel[1] != 1811u) ||
        (crsf.channels_age_us != 0u)) {
        differs("a right frame after a gap");
    }
}

/* What a frame says, as the other decoder reads it. */
static void compare_frame(keel_crsf_taken_t taken, const uint16_t *channel, const uint8_t *said)
{
    const keel_crsf_link_t *const link = &crsf.link;
    const uint8_t ours[6] = {link->rssi[0],      link->rssi[1], link->quality,
                             (uint8_t)link->snr, link->antenna, link->mode};

    if ((taken == KEEL_CRSF_TOOK_CHANNELS) &&
        (memcmp(crsf.channel, channel, sizeof crsf.channel) != 0)) {
        differs("the channels that crsf reads");
    }
    if ((taken == KEEL_CRSF_TOOK_LINK) && (memcmp(ours, said, sizeof ours) != 0)) {
        differs("the statistics that crsf reads");
    }
}

/* What crsf is shown of a frame: its first so many bytes, as a frame of its own whose CRC is right
 * when the frame's is. With a longer one than its type needs, crsf reads behind the frame, where
 * the standard asks for the part that is known; and it knows not all first bytes. */
static void show_part(uint8_t *part, const uint8_t *frame, uint32_t length)
{
    const bool right = model_crsf_crc(&frame[2], frame[1] - 1u) == frame[frame[1] + 1u];

    memcpy(part, frame, length + 1u);
    part[0] = KEEL_CRSF_HEADER;
    part[1] = (uint8_t)length;
    part[length + 1u] = model_crsf_crc(&part[2], length - 1u) ^ (right ? 0u : 1u);
}

/* A frame behind a gap, with any first byte and of any length that its type may have: taken for
 * what crsf takes it for, and not else. */
static void judge_frame(const uint8_t *bytes)
{
    static const uint8_t first[4] = {KEEL_CRSF_HEADER, KEEL_CRSF_HEADER_ALL,
                                     KEEL_CRSF_HEADER_RECEIVER, KEEL_CRSF_HEADER_MODULE};
    static const uint8_t head[4][2] = {{KEEL_CRSF_LENGTH_CHANNELS, KEEL_CRSF_TYPE_CHANNELS},
                                       {KEEL_CRSF_LENGTH_LINK, KEEL_CRSF_TYPE_LINK},
                                       {KEEL_CRSF_LENGTH_MIN, 0x02},
                                       {KEEL_CRSF_LENGTH_MAX, 0x29}};
    const uint32_t known = head[bytes[0] & 3u][0];
    const uint32_t longer = ((bytes[0] & 2u) == 0u)
                                ? (bytes[1] % (KEEL_CRSF_LENGTH_MAX + 1u - known))
                                : 0u;
    uint8_t frame[KEEL_FRAMING_BYTES] = {first[(bytes[0] >> 2) & 3u], (uint8_t)(known + longer),
                                         head[bytes[0] & 3u][1]};
    uint8_t part[KEEL_FRAMING_BYTES];
    const uint32_t size = frame[1] + 2u;
    keel_crsf_taken_t taken = KEEL_CRSF_NOTHING;
    uint16_t channel[KEEL_CRSF_CHANNELS];
    uint8_t link[6];
    int32_t said;

    for (uint32_t i = 0u; i < size; i++) {
        frame[i] = (i < 3u) ? frame[i] : repaired(bytes[i]);
        taken = both_take(frame[i], (i == 0u) ? SILENT_US : BYTE_US);
    }
    show_part(part, frame, known);
    said = oracle_crsf(part, known + 2u, channel, link);
    if ((said == 0) ? ((taken != KEEL_CRSF_NOTHING) && (taken != KEEL_CRSF_TOOK_OTHER))
                    : (taken != ((said == 1) ? KEEL_CRSF_TOOK_CHANNELS : KEEL_CRSF_TOOK_LINK))) {
        differs("what crsf takes a frame for");
    }
    compare_frame(taken, channel, link);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const keel_crsf_config_t config = {
        .gap_us = 300u, .channels_us = 20000u, .link_us = (size % 2u) * 40000u};
    uint32_t elapsed_us = BYTE_US;

    memset(&crsf, 0, sizeof crsf);
    memset(&model, 0, sizeof model);
    (void)keel_crsf_init(&crsf, &config);
    (void)model_crsf_init(&model, &config);
    for (size_t i = 0u; (i < size) && !ALONE; i++) {
        (void)both_take(repaired(data[i]), elapsed_us);
        elapsed_us = ((i > 0u) && (data[i] == 0x5Au) && (data[i - 1u] == 0xA5u)) ? SILENT_US
                                                                                 : BYTE_US;
    }
    if (!ALONE) {
        take_right_frame();
    }
    if (size >= KEEL_FRAMING_BYTES) {
        judge_frame(&data[size - KEEL_FRAMING_BYTES]);
    }
    return 0;
}
