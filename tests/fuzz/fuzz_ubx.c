/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_ubx.c
 * @brief libFuzzer target: any string of bytes goes to the decoder of UBX and to its model; they
 *        never differ, and of a message behind a gap another decoder, ublox, thinks the same.
 *
 *     make check NAME=fuzz ARGS="--filter ubx"
 *
 * The first byte is the configuration. 0xA5 0x5A is a gap before the next byte. Checksums are made
 * right for most messages, as few would be by chance.
 */
#include "../../specs/model/ubx.h"
#include "oracles.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BYTE_US   87u
#define SILENT_US 80000u
#define HEAD      6u
#define SUMS      2u

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static keel_ubx_t ubx;
static keel_ubx_t model;

static void differs(const char *what)
{
    fprintf(stderr, "decoder and model DIFFER: %s\n", what);
    abort();
}

/* The byte of the right checksum that is due, or the one that came. */
static uint8_t repaired(uint8_t byte)
{
    if ((byte & 1u) != 0u) {
        return byte;
    }
    return (ubx.step == KEEL_UBX_SUM_A)   ? ubx.sum_a
           : (ubx.step == KEEL_UBX_SUM_B) ? ubx.sum_b
                                          : byte;
}

static bool both_take(uint8_t byte, uint32_t elapsed_us)
{
    const bool taken = keel_ubx_take(&ubx, byte, elapsed_us);

    if (ALONE) {
        return taken;
    }
    if (model_ubx_take(&model, byte, elapsed_us) != taken) {
        differs("whether a fix ends");
    }
    if (memcmp(&ubx, &model, sizeof ubx) != 0) {
        differs("a field");
    }
    if (keel_ubx_judge(&ubx) != model_ubx_judge(&model)) {
        differs("the verdict");
    }
    return taken;
}

/* A NAV-PVT behind a gap: taken when ublox takes it, with the same fields, and not else. Of 92 and
 * 84 bytes, for which ublox has protocols; those of other lengths are compared with the model. */
static void judge_message(const uint8_t *payload, uint32_t length, uint8_t last)
{
    const uint8_t head[HEAD] = {0xB5u, 0x62u, 0x01u, 0x07u, (uint8_t)length, 0x00u};
    const uint32_t size = HEAD + length + SUMS;
    uint8_t message[KEEL_UBX_BYTES];
    int64_t said[13];
    bool taken = false;

    for (uint32_t i = 0u; i < size; i++) {
        const uint8_t byte = (i < HEAD)              ? head[i]
                             : (i < (HEAD + length)) ? payload[i - HEAD]
                                                     : repaired(last);

        message[i] = byte;
        taken = both_take(byte, (i == 0u) ? SILENT_US : BYTE_US);
    }
    if (taken != ((length == KEEL_UBX_PAYLOAD) ? oracle_ubx(message, size, said)
                                               : oracle_ubx_14(message, size, said))) {
        differs("whether ublox takes a message");
    }
    if (taken) {
        const keel_ubx_fix_t *const fix = &ubx.fix;
        const int64_t ours[13] = {fix->tow_ms,         fix->longitude,   fix->latitude,
                                  fix->height_mm,      fix->accuracy_mm, fix->height_accuracy,
                                  fix->north,          fix->east,        fix->down,
                                  fix->speed_accuracy, fix->type,        fix->satellites,
                                  fix->is_ok};

        if (memcmp(ours, said, sizeof ours) != 0) {
            differs("what ublox reads");
        }
    }
}

/* Whether a NAV-PVT's beginning is within its payload: then it is another one, for us. */
static bool begins_within(const uint8_t *payload, uint32_t length)
{
    for (uint32_t i = 0u; (i + 1u) < length; i++) {
        if ((payload[i] == 0xB5u) && (payload[i + 1u] == 0x62u)) {
            return true;
        }
    }
    return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t kind = (size > 0u) ? data[0] : 0u;
    const keel_ubx_config_t config = {.gap_us = ((kind & 1u) != 0u) ? 20000u : UINT32_MAX,
                                      .max_age_us = 500000u,
                                      .accuracy_mm = 5000u,
                                      .speed_accuracy = 1000u};
    const uint32_t length = ((kind & 0x80u) != 0u) ? KEEL_UBX_PAYLOAD_LEAST : KEEL_UBX_PAYLOAD;
    uint32_t elapsed_us = BYTE_US;

    memset(&ubx, 0, sizeof ubx);
    memset(&model, 0, sizeof model);
    (void)keel_ubx_init(&ubx, &config);
    (void)model_ubx_init(&model, &config);
    for (size_t i = 1u; (i < size) && !ALONE; i++) {
        (void)both_take(repaired(data[i]), elapsed_us);
        elapsed_us = ((data[i] == 0x5Au) && (data[i - 1u] == 0xA5u)) ? SILENT_US : BYTE_US;
    }
    if ((size > length) && ((kind & 1u) != 0u) && !begins_within(&data[size - length], length)) {
        judge_message(&data[size - length], length, kind >> 1);
    }
    return 0;
}
