/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_sbus.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of SBUS and to its model; they
 *        never differ, and of 25 bytes behind a gap another decoder, uf-sbus, thinks the same.
 *
 *     make check NAME=fuzz ARGS="--filter sbus"
 *
 * The first byte is the configuration. 0xA5 is a gap before the next byte. Flags and footers are
 * made right for most frames, as few would be by chance.
 */
#include "../../specs/model/sbus.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTE_US   120u
#define SILENT_US 3000u
#define FLAGS     (KEEL_SBUS_BYTES - 2)
#define FOOTER    (KEEL_SBUS_BYTES - 1)

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static keel_sbus_t sbus;
static keel_sbus_t model;

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* Right flags and a right footer where they are due, or the byte that came. */
static uint8_t repaired(uint8_t byte)
{
    if ((byte & 1u) != 0u) {
        return byte;
    }
    return (sbus.held == FLAGS) ? (byte & 0x0Fu) : ((sbus.held == FOOTER) ? 0u : byte);
}

/* What a frame says, as uf-sbus reads it. */
static void compare_frame(const uint16_t *channel, uint8_t flags)
{
    const keel_sbus_frame_t *const frame = &sbus.frame;

    if ((memcmp(frame->channel, channel, sizeof frame->channel) != 0) ||
        (frame->digital_17 != ((flags & 1u) != 0u)) ||
        (frame->digital_18 != ((flags & 2u) != 0u)) || (frame->lost != ((flags & 4u) != 0u)) ||
        (frame->failsafe != ((flags & 8u) != 0u))) {
        differs("what uf-sbus reads");
    }
}

static bool both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool taken = keel_sbus_take(&sbus, byte, elapsed_us);

    if (ALONE) {
        return taken;
    }
    if (model_sbus_take(&model, byte, elapsed_us) != taken) {
        differs("whether a frame ends");
    }
    if (memcmp(&sbus, &model, sizeof sbus) != 0) {
        differs("a field");
    }
    return taken;
}

/* uf-sbus takes channels of any value. */
static bool is_wanted(const uint16_t *channel)
{
    bool wanted = true;

    for (uint32_t i = 0u; i < KEEL_SBUS_CHANNELS; i++) {
        wanted = wanted &&
                 (((sbus.config.judged & (1u << i)) == 0u) ||
                  ((channel[i] >= sbus.config.lowest) && (channel[i] <= sbus.config.highest)));
    }
    return wanted;
}

/* A header and 24 bytes behind a gap: taken when uf-sbus takes them, and not else. */
static void judge_frame(const uint8_t *bytes)
{
    uint8_t frame[KEEL_SBUS_BYTES];
    uint16_t channel[KEEL_SBUS_CHANNELS];
    uint8_t flags;
    bool taken = false;

    for (uint32_t i = 0u; i < KEEL_SBUS_BYTES; i++) {
        frame[i] = (i == 0u) ? KEEL_SBUS_HEADER : repaired(bytes[i]);
        taken = both_take(frame[i], (i == 0u) ? SILENT_US : BYTE_US);
    }
    if (taken != (oracle_sbus(frame, channel, &flags) && is_wanted(channel))) {
        differs("whether uf-sbus takes a frame");
    }
    if (taken) {
        compare_frame(channel, flags);
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t kind = (size > 0u) ? data[0] : 0u;
    const keel_sbus_config_t config = {.gap_us = 1000u,
                                       .lowest = ((kind & 1u) != 0u) ? 172u : 0u,
                                       .highest = ((kind & 1u) != 0u) ? 1811u : 2047u,
                                       .judged = ((kind & 2u) != 0u) ? 0x000Fu : 0xFFFFu};
    uint32_t elapsed_us = BYTE_US;

    memset(&sbus, 0, sizeof sbus);
    memset(&model, 0, sizeof model);
    (void)keel_sbus_init(&sbus, &config);
    (void)model_sbus_init(&model, &config);
    for (size_t i = 1u; (i < size) && !ALONE; i++) {
        (void)both_take(repaired(data[i]), elapsed_us);
        elapsed_us = (data[i] == 0xA5u) ? SILENT_US : BYTE_US;
    }
    if (size >= KEEL_SBUS_BYTES) {
        judge_frame(&data[size - KEEL_SBUS_BYTES]);
    }
    return 0;
}
