/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file oversample.h
 * @brief Oversampling of one channel (fig. 7): a background task adds samples, a foreground task
 *        takes their mean.
 *
 * The background runs factor times as often as the foreground. When it ran less or more often
 * between two takes, the missed or extra runs are counted and reported. A sample that is not finite
 * or too large is refused and does not enter the mean; its run counts all the same. So two refusals
 * write here, as STA-001 says: what they count tells that samples are lost.
 */
#ifndef KEEL_MIDDLEWARE_OVERSAMPLE_H
#define KEEL_MIDDLEWARE_OVERSAMPLE_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** The largest magnitude of a sample, in the channel's unit. */
#define KEEL_OVERSAMPLE_RANGE 1.0e9f

/** A channel. Only the functions below write it; all of it may be read. */
typedef struct keel_oversample {
    float sum;       /**< Of the samples since the last take. */
    float least;     /**< The smallest of them; KEEL_OVERSAMPLE_RANGE when there is none. */
    float most;      /**< The largest of them; -KEEL_OVERSAMPLE_RANGE when there is none. */
    uint32_t missed; /**< Background runs that were missing in all takes; saturates. */
    uint32_t extra;  /**< Background runs that were too many in all takes; saturates. */
    uint16_t count;  /**< Samples in the sum. */
    uint16_t runs;   /**< Background runs since the last take; saturates. */
    uint16_t factor; /**< Background runs that a foreground period should have. */
} keel_oversample_t;

/**
 * Makes a channel ready (requirement OVS-001).
 *
 * @param oversample the channel
 * @param factor     background runs in a foreground period, at least 1
 * @return KEEL_OK, or KEEL_ERR_FACTOR when the factor is 0; nothing changes then
 */
keel_status_t keel_oversample_init(keel_oversample_t *oversample, uint16_t factor);

/**
 * Adds a sample: the background's part (requirements OVS-002 and OVS-003).
 *
 * @param oversample the channel
 * @param value      the sample; any bit pattern
 * @return KEEL_OK; KEEL_ERR_VALUE when it is not finite or beyond KEEL_OVERSAMPLE_RANGE: the run is
 *         counted all the same, and nothing else changes; KEEL_ERR_FULL when there are 65535 runs
 *         already: then nothing changes
 */
keel_status_t keel_oversample_add(keel_oversample_t *oversample, float value);

/**
 * Takes the mean and starts again: the foreground's part (requirements OVS-004 to OVS-006).
 *
 * @param oversample the channel
 * @param mean       the mean of the samples since the last take, within the smallest and the
 *                   largest of them; left as it is when there is none
 * @return KEEL_OK, or KEEL_ERR_STATE when no sample was added: the missing and the extra runs are
 *         counted all the same and the channel starts again, but the mean stays
 */
keel_status_t keel_oversample_take(keel_oversample_t *oversample, float *mean);

KEEL_C_END

#endif
