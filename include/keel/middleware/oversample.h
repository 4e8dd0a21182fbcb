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

/*@ predicate oversample_valid(keel_oversample_t *o) =
  @     o->factor > 0 && o->count <= o->runs && \is_finite(o->sum) && \is_finite(o->least) &&
  @     \is_finite(o->most) && -0x1p30 * o->count <= o->sum <= 0x1p30 * o->count &&
  @     -KEEL_OVERSAMPLE_RANGE <= o->least <= KEEL_OVERSAMPLE_RANGE &&
  @     -KEEL_OVERSAMPLE_RANGE <= o->most <= KEEL_OVERSAMPLE_RANGE &&
  @     (o->count > 0 ==> o->least <= o->most) &&
  @     (o->count == 0 ==> o->least == KEEL_OVERSAMPLE_RANGE && o->most == -KEEL_OVERSAMPLE_RANGE);
  @*/

/**
 * Makes a channel ready (requirement OVS-001).
 *
 * @param oversample the channel
 * @param factor     background runs in a foreground period, at least 1
 * @return KEEL_OK, or KEEL_ERR_FACTOR when the factor is 0; nothing changes then
 */
/*@ requires \valid(oversample);
  @ assigns *oversample;
  @ behavior refused:
  @   assumes factor == 0;
  @   assigns \nothing;
  @   ensures OVS_001_refused: \result == KEEL_ERR_FACTOR;
  @ behavior ready:
  @   assumes factor > 0;
  @   ensures OVS_001_ready: \result == KEEL_OK && oversample->factor == factor &&
  @       oversample->count == 0 && oversample->runs == 0 && oversample->missed == 0 &&
  @       oversample->extra == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
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
/*@ requires \valid(oversample) && oversample_valid(oversample);
  @ assigns oversample->sum, oversample->least, oversample->most, oversample->count,
  @         oversample->runs;
  @ ensures OVS_002_valid: oversample_valid(oversample);
  @ ensures OVS_002_runs: oversample->runs == \min(\old(oversample->runs) + 1, UINT16_MAX);
  @ ensures OVS_002_count: \result == KEEL_OK ==>
  @     oversample->count == \old(oversample->count) + 1;
  @ ensures OVS_003_refused: \result != KEEL_OK ==>
  @     oversample->count == \old(oversample->count) && oversample->sum == \old(oversample->sum) &&
  @     oversample->least == \old(oversample->least) && oversample->most == \old(oversample->most);
  @ ensures OVS_003_full: \result == KEEL_ERR_FULL <==> \old(oversample->runs) == UINT16_MAX;
  @ ensures OVS_003_value: \result == KEEL_ERR_VALUE <==>
  @     \old(oversample->runs) < UINT16_MAX && !(\is_finite(value) &&
  @     -KEEL_OVERSAMPLE_RANGE <= value <= KEEL_OVERSAMPLE_RANGE);
  @ ensures OVS_003_status: \result == KEEL_OK || \result == KEEL_ERR_FULL ||
  @     \result == KEEL_ERR_VALUE;
  @*/
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
/*@ requires \valid(oversample) && oversample_valid(oversample);
  @ requires \valid(mean) && \separated(oversample, mean);
  @ assigns *oversample, *mean;
  @ ensures OVS_004_mean: \old(oversample->count) > 0 ==> \result == KEEL_OK &&
  @     \is_finite(*mean) && \old(oversample->least) <= *mean <= \old(oversample->most);
  @ ensures OVS_004_none: \old(oversample->count) == 0 ==> \result == KEEL_ERR_STATE;
  @ ensures OVS_004_stays: \result != KEEL_OK ==> *mean == \old(*mean);
  @ ensures OVS_005_anew: oversample_valid(oversample) && oversample->count == 0 &&
  @     oversample->runs == 0 && oversample->factor == \old(oversample->factor);
  @ ensures OVS_006_missed: oversample->missed == \min(UINT32_MAX, \old(oversample->missed) +
  @     \max(0, oversample->factor - \old(oversample->runs)));
  @ ensures OVS_006_extra: oversample->extra == \min(UINT32_MAX, \old(oversample->extra) +
  @     \max(0, \old(oversample->runs) - oversample->factor));
  @*/
keel_status_t keel_oversample_take(keel_oversample_t *oversample, float *mean);

KEEL_C_END

#endif
