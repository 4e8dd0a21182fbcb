/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file fuzz_scheduler.c
 * @brief libFuzzer target: any string of bytes drives the kernel and its model; they never differ.
 *
 *     make check NAME=fuzz ARGS="--filter scheduler"
 */
#include "../property/drive.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char difference[256];
    drive_tally_t tally;

    memset(&tally, 0, sizeof tally);
    if (!drive(data, size, &tally, difference, sizeof difference, NULL)) {
        memset(&tally, 0, sizeof tally);
        drive(data, size, &tally, difference, sizeof difference, stderr);
        fprintf(stderr, "kernel and model DIFFER: %s\n", difference);
        abort();
    }
    return 0;
}
