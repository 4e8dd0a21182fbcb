/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_crsf.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of CRSF and to its model; they
 *        never differ, and after a gap a right frame is taken, whatever was before.
 *
 *     python3 tools/run_tests.py --filter fuzz_crsf --fuzz 60
 *
 * 0xA5 0x5A is a gap. CRCs are made right for every other frame, as few would be by chance.
 */
#include "../../specs/model/crsf.h"

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
    const uint8_t *const frame = model.framing.byte;
    const uint32_t held = model.framing.held;

    if ((held < 3u) || (held != (frame[1] + 1u)) || ((frame[2] & 1u) != 0u)) {
        return byte;
    }
    return model_crsf_crc(&frame[2], held - 2u);
}

static keel_crsf_taken_t both_take(uint8_t byte, uint32_t elapsed_us)
{
    const keel_crsf_taken_t expected = model_crsf_take(&model, byte, elapsed_us);

    if (keel_crsf_take(&crsf, byte, elapsed_us) != expected) {
        differs("what a byte ends");
    }
    if (memcmp(&crsf, &model, sizeof crsf) != 0) {
        differs("a field");
    }
    if (keel_crsf_is_lost(&crsf) != model_crsf_is_lost(&model)) {
        differs("whether the radio is lost");
    }
    return expected;
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

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const keel_crsf_config_t config = {
        .gap_us = 300u, .channels_us = 20000u, .link_us = (size % 2u) * 40000u};
    uint32_t elapsed_us = BYTE_US;

    memset(&crsf, 0, sizeof crsf);
    memset(&model, 0, sizeof model);
    (void)keel_crsf_init(&crsf, &config);
    (void)model_crsf_init(&model, &config);
    for (size_t i = 0u; i < size; i++) {
        (void)both_take(repaired(data[i]), elapsed_us);
        elapsed_us = ((i > 0u) && (data[i] == 0x5Au) && (data[i - 1u] == 0xA5u)) ? SILENT_US
                                                                                 : BYTE_US;
    }
    take_right_frame();
    return 0;
}
