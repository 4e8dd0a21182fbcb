/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/deviation.h
 * @brief The contracts of deviation.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_DEVIATION_H
#define KEEL_INTERNAL_RTOS_DEVIATION_H

#include "keel/c_declarations.h"
#include "keel/rtos/deviation.h"

KEEL_C_BEGIN

/*@ logic integer distance(integer a, integer b) = (a >= b) ? a - b : b - a;
  @
  @ // The square that a start at start_us adds to eq. 15's sum.
  @ logic integer deviation_square(integer last_us, integer start_us, integer period_us) =
  @     distance(start_us - last_us, period_us) * distance(start_us - last_us, period_us);
  @*/

/*@ requires \valid(deviation);
  @ requires deviation->starts > 0 ==> deviation->start_us <= start_us;
  @ assigns *deviation;
  @ behavior first:
  @   assumes deviation->starts == 0;
  @   ensures DEV_001_first: \result == KEEL_OK && deviation->starts == 1 &&
  @       deviation->start_us == start_us && deviation->sum_us2 == \old(deviation->sum_us2);
  @ behavior added:
  @   assumes 0 < deviation->starts < UINT32_MAX;
  @   assumes distance(start_us - deviation->start_us, period_us) <= UINT32_MAX;
  @   assumes deviation->sum_us2
  @           + deviation_square(deviation->start_us, start_us, period_us) <= UINT64_MAX;
  @   ensures ok: \result == KEEL_OK;
  @   ensures DEV_001_sum: deviation->sum_us2 == \old(deviation->sum_us2)
  @       + deviation_square(\old(deviation->start_us), start_us, period_us);
  @   ensures DEV_001_start: deviation->start_us == start_us;
  @   ensures DEV_001_starts: deviation->starts == \old(deviation->starts) + 1;
  @ behavior refused:
  @   assumes deviation->starts > 0;
  @   assumes deviation->starts == UINT32_MAX ||
  @       distance(start_us - deviation->start_us, period_us) > UINT32_MAX ||
  @       deviation->sum_us2
  @           + deviation_square(deviation->start_us, start_us, period_us) > UINT64_MAX;
  @   assigns \nothing;
  @   ensures DEV_002: \result == KEEL_ERR_STATE;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                 uint32_t period_us);

/*@ requires \valid_read(deviation);
  @ assigns \nothing;
  @ ensures DEV_003_none: deviation->starts < 2 ==> \result == 0;
  @ ensures DEV_003_mean: deviation->starts >= 2 ==>
  @     \result == deviation->sum_us2 / (deviation->starts - 1);
  @*/
uint64_t keel_deviation_variance_us2(const keel_deviation_t *deviation);

KEEL_C_END

#endif
