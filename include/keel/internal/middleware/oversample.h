/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/oversample.h
 * @brief The contracts of oversample.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_OVERSAMPLE_H
#define KEEL_INTERNAL_MIDDLEWARE_OVERSAMPLE_H

#include "keel/c_declarations.h"
#include "keel/middleware/oversample.h"

KEEL_C_BEGIN

/*@ predicate oversample_valid(keel_oversample_t *o) =
  @     o->factor > 0 && o->count <= o->runs && \is_finite(o->sum) && \is_finite(o->least) &&
  @     \is_finite(o->most) && -0x1p30 * o->count <= o->sum <= 0x1p30 * o->count &&
  @     -KEEL_OVERSAMPLE_RANGE <= o->least <= KEEL_OVERSAMPLE_RANGE &&
  @     -KEEL_OVERSAMPLE_RANGE <= o->most <= KEEL_OVERSAMPLE_RANGE &&
  @     (o->count > 0 ==> o->least <= o->most) &&
  @     (o->count == 0 ==> o->least == KEEL_OVERSAMPLE_RANGE && o->most == -KEEL_OVERSAMPLE_RANGE);
  @*/

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
