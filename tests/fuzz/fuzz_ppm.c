/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_ppm.c
 * @brief libFuzzer target: any times between edges go to the PPM decoder and to its model; they
 *        never differ, and of up to 20 edges another decoder, ppm_decode, thinks the same.
 *
 *     make check NAME=fuzz ARGS="--filter ppm"
 *
 * The first byte is the configuration. Each byte behind it is an edge: most of them behind a
 * channel, some behind a sync gap, and some behind a time that the next two bytes say.
 */
#include "../../specs/model/ppm.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

static uint32_t width_of(const uint8_t *data, size_t left)
{
    if (data[0] < 200u) {
        return 800u + (7u * (uint32_t)data[0]);
    }
    if ((data[0] < 240u) || (left < 3u)) {
        return 8000u;
    }
    return ((uint32_t)data[1] << (data[0] % 25u)) + data[2];
}

/* The most edges that ppm_decode has room for in any case. */
#define EDGES 20

/* Most times are a channel's, some a sync gap's, and some beside the ends of both. */
static uint32_t plain_width(uint8_t byte)
{
    static const uint32_t end[16] = {1u,    799u,  800u,  801u,  2199u, 2200u, 2201u,  3999u,
                                     4000u, 4001u, 1500u, 1000u, 2000u, 9999u, 10000u, 12000u};

    if (byte < 200u) {
        return 800u + (7u * (uint32_t)byte);
    }
    return (byte < 240u) ? (4000u + (200u * (byte - 200u))) : end[byte - 240u];
}

/* Edges behind the start, a frame at most: taken when ppm_decode takes it, and not else. */
static void judge_frame(const uint8_t *bytes, size_t count, uint8_t least)
{
    const keel_ppm_config_t config = {.lost_us = 100000u,
                                      .lowest_us = 800u,
                                      .highest_us = 2200u,
                                      .sync_us = 4000u,
                                      .judged = 0xFFFFu,
                                      .least = least,
                                      .frames_to_take = 1u};
    uint32_t width[EDGES];
    uint16_t channel[KEEL_PPM_CHANNELS];
    keel_ppm_t ppm;
    uint32_t said;
    bool taken;

    (void)keel_ppm_init(&ppm, &config);
    taken = keel_ppm_take(&ppm, 1u);
    for (size_t i = 0u; i < count; i++) {
        /* A frame in the middle, for few would begin and end by chance. */
        const bool is_sync = (i == 0u) || ((i == (count - 1u)) && ((bytes[0] & 1u) == 0u));

        width[i] = is_sync ? (4000u + bytes[i]) : plain_width(bytes[i]);
        taken = keel_ppm_take(&ppm, width[i]);
    }
    said = oracle_ppm(width, count, least, channel);
    if (taken != ((said > 0u) && (said <= KEEL_PPM_CHANNELS))) {
        differs("whether ppm_decode takes a frame");
    }
    if (taken &&
        ((ppm.channels != said) || (memcmp(ppm.channel, channel, said * sizeof channel[0]) != 0))) {
        differs("what ppm_decode reads");
    }
}

/* All of it, to the decoder and to its model. */
static void compare_with_model(const uint8_t *data, size_t size, uint8_t kind)
{
    static keel_ppm_t ppm;
    static keel_ppm_t model;
    const keel_ppm_config_t config = {
        .lost_us = ((kind & 1u) != 0u) ? UINT32_MAX : 100000u,
        .lowest_us = 800u,
        .highest_us = 2200u,
        .sync_us = ((kind & 2u) != 0u) ? 2201u : 2300u,
        .judged = ((kind & 16u) != 0u) ? 0x000Fu : 0xFFFFu,
        .least = (uint8_t)(1u + ((kind >> 2) % 16u)),
        .frames_to_take = ((kind & 64u) != 0u) ? 255u : 3u,
    };

    memset(&ppm, 0, sizeof ppm);
    memset(&model, 0, sizeof model);
    (void)keel_ppm_init(&ppm, &config);
    (void)model_ppm_init(&model, &config);
    for (size_t i = 1u; i < size; i++) {
        const uint32_t width = width_of(&data[i], size - i);

        if ((kind & 128u) != 0u) {
            keel_ppm_pass_time(&ppm, data[i]);
            model_ppm_pass_time(&model, data[i]);
        }
        if (model_ppm_take(&model, width) != keel_ppm_take(&ppm, width)) {
            differs("whether channels are taken");
        }
        if (model_ppm_is_lost(&model) != keel_ppm_is_lost(&ppm)) {
            differs("whether the radio is lost");
        }
        if (memcmp(&ppm, &model, sizeof ppm) != 0) {
            differs("a field");
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t kind = (size > 0u) ? data[0] : 0u;

    if (!ALONE) {
        compare_with_model(data, size, kind);
    }
    if (size > 1u) {
        const size_t count = ((size - 1u) < EDGES) ? (size - 1u) : EDGES;

        judge_frame(&data[size - count], count, (uint8_t)(1u + ((kind >> 2) % 16u)));
    }
    return 0;
}
