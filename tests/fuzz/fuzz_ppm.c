/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_ppm.c
 * @brief libFuzzer target: any times between edges go to the PPM decoder and to its model; they
 *        never differ.
 *
 *     make fuzz ARGS="--filter ppm"
 *
 * The first byte is the configuration. Each byte behind it is an edge: most of them behind a
 * channel, some behind a sync gap, and some behind a time that the next two bytes say.
 */
#include "../../specs/model/ppm.h"

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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static keel_ppm_t ppm;
    static keel_ppm_t model;
    const uint8_t kind = (size > 0u) ? data[0] : 0u;
    const keel_ppm_config_t config = {
        .lost_us = ((kind & 1u) != 0u) ? UINT32_MAX : 100000u,
        .lowest_us = 800u,
        .highest_us = 2200u,
        .sync_us = ((kind & 2u) != 0u) ? 2201u : 2300u,
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
    return 0;
}
