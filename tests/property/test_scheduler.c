/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file test_scheduler.c
 * @brief Property test: random operations on the kernel and on its model; the two never differ.
 *
 *     test_scheduler [--seed N] [--steps N]
 *
 * On a difference the string of bytes that led to it is made as short as it will go, and what it
 * does is told operation by operation.
 */
#include "../unit/any.h"
#include "drive.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST          4096u /* Bytes of one session. */
#define SHRINK_TRIALS    20000u
#define ENOUGH_FOR_TALLY 100000u /* Steps after which everything must have happened. */

static char difference[256];

static bool agrees(const uint8_t *bytes, size_t size)
{
    drive_tally_t tally;

    memset(&tally, 0, sizeof tally);
    return drive(bytes, size, &tally, difference, sizeof difference, NULL);
}

/* Leaves out runs of bytes, long ones first, as long as the two still differ. */
static size_t shrink(uint8_t *bytes, size_t size)
{
    static uint8_t shorter[LONGEST];
    unsigned trials = 0;
    size_t chunk = size / 2;

    while (chunk > 0) {
        bool shrunk = false;

        for (size_t at = 0; ((at + chunk) <= size) && (trials < SHRINK_TRIALS);) {
            memcpy(shorter, bytes, at);
            memcpy(shorter + at, bytes + at + chunk, size - at - chunk);
            trials++;
            if (agrees(shorter, size - chunk)) {
                at += chunk;
            } else {
                size -= chunk;
                memcpy(bytes, shorter, size);
                shrunk = true;
            }
        }
        if (!shrunk || (trials >= SHRINK_TRIALS)) {
            chunk /= 2;
        }
    }
    return size;
}

static int report_difference(uint8_t *bytes, size_t size, uint64_t seed, uint64_t step)
{
    drive_tally_t tally;

    printf("property: kernel and model DIFFER, seed %" PRIu64 ", step %" PRIu64 ": %s\n", seed,
           step, difference);
    size = shrink(bytes, size);
    memset(&tally, 0, sizeof tally);
    printf("property: shrunk to %zu bytes, which do this:\n", size);
    drive(bytes, size, &tally, difference, sizeof difference, stdout);
    printf("property: then %s\n", difference);
    return 1;
}

/* Everything that the test is about has happened at least this once. */
static int report_tally(const drive_tally_t *t)
{
    const struct {
        const char *name;
        uint64_t count;
    } rows[] = {
        {"real-time runs", t->realtime_runs},
        {"other runs", t->other_runs},
        {"promotions", t->promotions},
        {"forgotten overruns", t->forgotten},
        {"unpromoted runs", t->unpromoted},
        {"missed releases", t->missed_releases},
        {"overruns", t->overruns},
        {"adds inside a task", t->inside_adds},
        {"removes inside", t->inside_removes},
        {"self-removals", t->self_removes},
        {"reports inside", t->inside_reports},
        {"sleeping steps", t->sleeping_steps},
        {"wraps", t->wraps},
    };
    int missing = 0;

    for (size_t i = 0; i < (sizeof rows / sizeof rows[0]); i++) {
        printf("property: %-18s %12" PRIu64 "\n", rows[i].name, rows[i].count);
        missing += (rows[i].count == 0) ? 1 : 0;
    }
    for (int i = 0; i < DRIVE_STATUSES; i++) {
        printf("property: status %-11d %12" PRIu64 "\n", i, t->status[i]);
        missing += (t->status[i] == 0) ? 1 : 0;
    }
    if ((missing > 0) && (t->operations >= ENOUGH_FOR_TALLY)) {
        printf("property: %d of these never happened\n", missing);
        return 1;
    }
    return 0;
}

static int test(uint64_t seed, uint64_t steps)
{
    static uint8_t bytes[LONGEST];
    drive_tally_t tally;
    uint64_t told = 0;

    memset(&tally, 0, sizeof tally);
    any_from(seed);
    while (tally.operations < steps) {
        const size_t size = 64 + (size_t)(any_64() % (LONGEST - 64));

        for (size_t i = 0; i < size; i++) {
            bytes[i] = (uint8_t)any_64();
        }
        if (!drive(bytes, size, &tally, difference, sizeof difference, NULL)) {
            return report_difference(bytes, size, seed, tally.operations);
        }
        if ((tally.operations - told) >= (steps / 5)) {
            told = tally.operations;
            printf("property: %" PRIu64 " of %" PRIu64 " steps\n", told, steps);
            fflush(stdout);
        }
    }
    if (report_tally(&tally) != 0) {
        return 1;
    }
    printf("property: %" PRIu64 " steps, no difference\n", tally.operations);
    return 0;
}

int main(int argc, char **argv)
{
    uint64_t seed = 1;
    uint64_t steps = 1000000;

    for (int i = 1; (i + 1) < argc; i += 2) {
        if (strcmp(argv[i], "--seed") == 0) {
            seed = strtoull(argv[i + 1], NULL, 10);
        } else if (strcmp(argv[i], "--steps") == 0) {
            steps = strtoull(argv[i + 1], NULL, 10);
        } else {
            fprintf(stderr, "property: no such option: %s\n", argv[i]);
            return 2;
        }
    }
    if ((argc % 2) == 0) {
        fprintf(stderr, "property: [--seed N] [--steps N]\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0); /* A crash must not swallow the seed. */
    printf("property: seed %" PRIu64 "\n", seed);
    return test(seed, steps);
}
