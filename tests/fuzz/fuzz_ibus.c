/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_ibus.c
 * @brief libFuzzer target: any string of bytes goes to the IBUS decoder and to its model; they
 *        never differ.
 *
 *     make fuzz ARGS="--filter ibus"
 *
 * The first byte is the configuration. 0xA5 is a gap before the next byte. Sums are made right,
 * unless the configuration says otherwise, as few would be by chance.
 */
#include "../../specs/model/framing.h"
#include "../../specs/model/ibus.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The byte of the right sum that is due, or the one that came. */
static uint8_t repaired(const keel_ibus_t *ibus, uint8_t byte)
{
    uint32_t left = 0xFFFFu;

    if (ibus->framing.held < 30u) {
        return byte;
    }
    for (uint32_t i = 0u; i < 30u; i++) {
        left -= ibus->framing.byte[i];
    }
    return (uint8_t)((ibus->framing.held == 30u) ? (left & 0xFFu) : (left >> 8));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static keel_ibus_t ibus;
    static keel_ibus_t model;
    const uint8_t kind = (size > 0u) ? data[0] : 0u;
    const keel_ibus_config_t config = {
        .gap_us = ((kind & 1u) != 0u) ? 500u : UINT32_MAX,
        .lowest = ((kind & 2u) != 0u) ? 0u : 900u,
        .highest = ((kind & 4u) != 0u) ? 4095u : 2100u,
        .extended = (kind & 8u) != 0u,
    };
    uint32_t elapsed_us = 87u;

    memset(&ibus, 0, sizeof ibus);
    memset(&model, 0, sizeof model);
    (void)keel_ibus_init(&ibus, &config);
    (void)model_ibus_init(&model, &config);
    for (size_t i = 1u; i < size; i++) {
        const uint8_t byte = ((kind & 16u) == 0u) ? repaired(&model, data[i]) : data[i];

        if (model_ibus_take(&model, byte, elapsed_us) != keel_ibus_take(&ibus, byte, elapsed_us)) {
            differs("whether a frame ends");
        }
        if (memcmp(&ibus, &model, sizeof ibus) != 0) {
            differs("a field");
        }
        elapsed_us = (data[i] == 0xA5u) ? 4000u : 87u;
    }
    return 0;
}
