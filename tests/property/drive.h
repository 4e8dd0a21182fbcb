/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file drive.h
 * @brief Drives the kernel and its model with one string of bytes, and compares them throughout.
 *
 * Each call is compared with the executable specification, too (lockstep.h).
 * The bytes decide everything: declarations, operations, how long tasks run, what they do inside.
 * So a string from a random generator makes a property test, one from libFuzzer a fuzz test, and
 * a failing one can be made shorter as any string can.
 */
#ifndef KEEL_TESTS_PROPERTY_DRIVE_H
#define KEEL_TESTS_PROPERTY_DRIVE_H

#include "keel/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define DRIVE_STATUSES (KEEL_ERR_STATE + 1)

/** What has happened, to see that nothing important never does. */
typedef struct drive_tally {
    uint64_t operations;             /**< Calls of the kernel, those from inside tasks included. */
    uint64_t status[DRIVE_STATUSES]; /**< How often each status was returned. */
    uint64_t realtime_runs;
    uint64_t other_runs;
    uint64_t promotions;
    uint64_t forgotten;  /**< Overruns that were remembered and are so no more. */
    uint64_t unpromoted; /**< Runs of other tasks where none is promoted. */
    uint64_t missed_releases;
    uint64_t overruns;
    uint64_t inside_adds;    /**< Tasks added from inside a task. */
    uint64_t inside_removes; /**< Tasks removed from inside another. */
    uint64_t self_removes;   /**< Tasks that removed themselves. */
    uint64_t inside_reports; /**< Reports of queued tasks that were taken inside a task. */
    uint64_t sleeping_steps; /**< Steps before wake_us. */
    uint64_t wraps;          /**< Times the counter wrapped. */
} drive_tally_t;

/**
 * Drives both until the bytes are used up or they differ.
 *
 * @param bytes      the string
 * @param size       its length
 * @param tally      is added to
 * @param difference receives what differs, if anything does
 * @param room       its size
 * @param trace      where each operation is told, or null
 * @return whether they agree
 */
bool drive(const uint8_t *bytes, size_t size, drive_tally_t *tally, char *difference, size_t room,
           FILE *trace);

#endif
