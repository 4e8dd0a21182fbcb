/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file progress.h
 * @brief How a device comes along that is asked step by step: times, and failures in a row.
 *
 * All times and counts stay at UINT32_MAX.
 */
#ifndef KEEL_BSP_COMMON_PROGRESS_H
#define KEEL_BSP_COMMON_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

/** The progress of a device. Written by the functions below alone; all of it may be read. */
typedef struct keel_progress {
    uint32_t passed_us; /**< Since it began what it is doing. */
    uint32_t age_us;    /**< Since the last sample was read; UINT32_MAX before the first. */
    uint32_t failures;  /**< Since the start. */
    uint32_t in_row;    /**< Of them, since the last sample, or since failed() said enough. */
} keel_progress_t;

/** The progress of a device that has not begun. */
keel_progress_t keel_progress_none(void);

/** Lets time pass. */
void keel_progress_pass(keel_progress_t *progress, uint32_t elapsed_us);

/** Notes that the device begins something. */
void keel_progress_begin(keel_progress_t *progress);

/** Notes a sample. */
void keel_progress_sample(keel_progress_t *progress);

/**
 * Notes a failure.
 *
 * @param progress the device's
 * @param limit    how many in a row are enough, at least 1
 * @return whether they are; then the row begins anew
 */
bool keel_progress_fail(keel_progress_t *progress, uint32_t limit);

/** The sum of two counts or times, or UINT32_MAX. */
uint32_t keel_progress_sum(uint32_t a, uint32_t b);

/** One more, or UINT32_MAX. */
uint32_t keel_progress_next(uint32_t count);

#endif
