/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_ibus.c
 * @brief libFuzzer target: any string of bytes goes to the IBUS decoder and to its model; they
 *        never differ, and of 32 bytes behind a gap another decoder, parse_rc_ibus, thinks the
 *        same.
 *
 *     make check NAME=fuzz ARGS="--filter ibus"
 *
 * The first byte is the configuration. 0xA5 is a gap before the next byte. Sums are made right,
 * unless the configuration says otherwise, as few would be by chance.
 */
#include "../../specs/model/framing.h"
#include "../../specs/model/ibus.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTE_US   87u
#define SILENT_US 4000u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static keel_ibus_t ibus;
static keel_ibus_t model;

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The byte of the right sum that is due, or the one that came. */
static uint8_t repaired(uint8_t byte)
{
    uint32_t left = 0xFFFFu;

    if (ibus.framing.held < 30u) {
        return byte;
    }
    for (uint32_t i = 0u; i < 30u; i++) {
        left -= ibus.framing.byte[i];
    }
    return (uint8_t)((ibus.framing.held == 30u) ? (left & 0xFFu) : (left >> 8));
}

static bool both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool taken = keel_ibus_take(&ibus, byte, elapsed_us);

    if (ALONE) {
        return taken;
    }
    if (model_ibus_take(&model, byte, elapsed_us) != taken) {
        differs("whether a frame ends");
    }
    if (memcmp(&ibus, &model, sizeof ibus) != 0) {
        differs("a field");
    }
    return taken;
}

/* The channels of 14 words of 16 bits, which are all that parse_rc_ibus knows. */
static void channels_of(const uint16_t word[14], uint16_t channel[KEEL_IBUS_CHANNELS])
{
    const bool extended = ibus.config.extended;

    for (uint32_t i = 0u; i < 14u; i++) {
        channel[i] = extended ? (word[i] & 0x0FFFu) : word[i];
    }
    for (uint32_t i = 0u; i < 4u; i++) {
        const uint16_t *const of = &word[3u * i];
        const uint32_t upper = (of[0] >> 12) | ((of[1] >> 12) << 4) | ((of[2] >> 12) << 8);

        channel[14u + i] = extended ? (uint16_t)upper : 0u;
    }
}

/* parse_rc_ibus takes channels of any value. */
static bool are_in_range(const uint16_t channel[KEEL_IBUS_CHANNELS])
{
    bool in_range = true;

    for (uint32_t i = 0u; i < (ibus.config.extended ? 18u : 14u); i++) {
        in_range = in_range &&
                   (((ibus.config.judged & ((uint32_t)1u << i)) == 0u) ||
                    ((channel[i] >= ibus.config.lowest) && (channel[i] <= ibus.config.highest)));
    }
    return in_range;
}

/* A header and 30 bytes behind a gap: taken when parse_rc_ibus takes them, and not else. In most
 * frames all bits are of 14 channels; in half of them the sum is right. */
static void judge_frame(const uint8_t *bytes, uint8_t kind)
{
    uint8_t frame[KEEL_IBUS_BYTES] = {KEEL_IBUS_HEADER, KEEL_IBUS_COMMAND};
    uint16_t word[14];
    uint16_t channel[KEEL_IBUS_CHANNELS];
    bool taken = false;
    bool wanted;

    for (uint32_t i = 0u; i < KEEL_IBUS_BYTES; i++) {
        const bool is_upper = ((i % 2u) == 1u) && ((kind & 40u) == 0u);
        const uint8_t byte = is_upper ? (bytes[i] & 0x0Fu) : bytes[i];

        frame[i] = (i < 2u) ? frame[i] : ((bytes[0] & 1u) == 0u) ? repaired(byte) : byte;
        taken = both_take(frame[i], (i == 0u) ? SILENT_US : BYTE_US);
    }
    wanted = oracle_ibus(frame, word);
    if (wanted) {
        channels_of(word, channel);
        wanted = are_in_range(channel);
    }
    if (taken != wanted) {
        differs("whether parse_rc_ibus takes a frame");
    }
    if (taken && (memcmp(ibus.channel, channel, sizeof channel) != 0)) {
        differs("what parse_rc_ibus reads");
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t kind = (size > 0u) ? data[0] : 0u;
    const keel_ibus_config_t config = {
        .gap_us = ((kind & 1u) != 0u) ? 500u : (SILENT_US - 1u),
        .judged = ((kind & 64u) != 0u) ? 0x0000Fu : 0x3FFFFu,
        .lowest = ((kind & 2u) != 0u) ? 0u : 900u,
        .highest = ((kind & 4u) != 0u) ? 4095u : 2100u,
        .extended = (kind & 8u) != 0u,
    };
    uint32_t elapsed_us = BYTE_US;

    memset(&ibus, 0, sizeof ibus);
    memset(&model, 0, sizeof model);
    (void)keel_ibus_init(&ibus, &config);
    (void)model_ibus_init(&model, &config);
    for (size_t i = 1u; (i < size) && !ALONE; i++) {
        (void)both_take(((kind & 16u) == 0u) ? repaired(data[i]) : data[i], elapsed_us);
        elapsed_us = (data[i] == 0xA5u) ? SILENT_US : BYTE_US;
    }
    if (size > KEEL_IBUS_BYTES) {
        judge_frame(&data[size - KEEL_IBUS_BYTES], kind);
    }
    return 0;
}
