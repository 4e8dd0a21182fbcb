/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/filter.h
 * @brief The contracts of filter.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_FILTER_H
#define KEEL_INTERNAL_FLIGHT_FILTER_H

#include "keel/c_declarations.h"
#include "keel/flight/filter.h"

KEEL_C_BEGIN

/*@ predicate filter_magnitude(float value, real most) =
  @     \is_finite(value) && -most <= value <= most;
  @
  @ // Wider than what the coefficients are, and enough for all that follows.
  @ predicate filter_coefficients(keel_filter_t filter) =
  @     filter_magnitude(filter.a, 2) && filter_magnitude(filter.b, 2) &&
  @     filter_magnitude(filter.c, 2);
  @
  @ predicate filter_low(keel_filter_t filter) =
  @     \is_finite(filter.energy_limit) && filter.energy_limit == KEEL_FILTER_LOW_ENERGY_LIMIT &&
  @     filter_magnitude(filter.s1, KEEL_FILTER_LOW_STATE_LIMIT) &&
  @     filter_magnitude(filter.s2, KEEL_FILTER_LOW_STATE_LIMIT) &&
  @     filter_magnitude(filter.output, KEEL_FILTER_LOW_OUTPUT_LIMIT);
  @
  @ predicate filter_high(keel_filter_t filter) =
  @     \is_finite(filter.energy_limit) && filter.energy_limit == KEEL_FILTER_HIGH_ENERGY_LIMIT &&
  @     filter_magnitude(filter.s1, KEEL_FILTER_HIGH_STATE_LIMIT) &&
  @     filter_magnitude(filter.s2, KEEL_FILTER_HIGH_STATE_LIMIT) &&
  @     filter_magnitude(filter.output, KEEL_FILTER_HIGH_OUTPUT_LIMIT);
  @
  @ predicate filter_bounded(keel_filter_t filter) = filter_low(filter) || filter_high(filter);
  @
  @ // Init establishes this, and every step keeps it.
  @ predicate filter_valid(keel_filter_t filter) =
  @     filter_coefficients(filter) && filter_bounded(filter);
  @
  @ predicate filter_input(float value) = filter_magnitude(value, KEEL_FILTER_INPUT_LIMIT);
  @
  @ predicate filter_rate(float rate_hz) =
  @     \is_finite(rate_hz) && KEEL_FILTER_RATE_MIN_HZ <= rate_hz <= KEEL_FILTER_RATE_MAX_HZ;
  @
  @ predicate filter_cutoff(float rate_hz, float cutoff_hz) =
  @     \is_finite(cutoff_hz) && 2 * cutoff_hz < rate_hz &&
  @     rate_hz * KEEL_FILTER_RATIO_MIN <= cutoff_hz; // both products are exact in the code
  @*/

/*@ requires \valid(filter);
  @ assigns *filter;
  @ behavior bad_rate:
  @   assumes !filter_rate(rate_hz);
  @   assigns \nothing;
  @   ensures FLT_001_rate: \result == KEEL_ERR_RATE;
  @ behavior bad_cutoff:
  @   assumes filter_rate(rate_hz) && !filter_cutoff(rate_hz, cutoff_hz);
  @   ensures FLT_001_cutoff: \result == KEEL_ERR_CUTOFF;
  @   ensures FLT_001_unchanged: *filter == \old(*filter);
  @ behavior made:
  @   assumes filter_rate(rate_hz) && filter_cutoff(rate_hz, cutoff_hz);
  @   ensures FLT_001_ok: \result == KEEL_OK;
  @   ensures FLT_002_coefficients: filter_coefficients(*filter);
  @   ensures FLT_003_rest: filter->s1 == 0 && filter->s2 == 0 && filter->output == 0;
  @   ensures FLT_003_valid: filter_valid(*filter);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz);

/*@ requires \valid(filter);
  @ requires filter_valid(*filter);
  @ assigns filter->s1, filter->s2, filter->output;
  @ ensures FLT_004_coefficients: filter_coefficients(*filter);
  @ ensures FLT_004_low: \old(filter_low(*filter)) ==> filter_low(*filter);
  @ ensures FLT_004_high: \old(filter_high(*filter)) ==> filter_high(*filter);
  @ behavior rest:
  @   assumes filter_input(value);
  @   ensures FLT_004_ok: \result == KEEL_OK;
  @   ensures FLT_004_rest: filter->s1 == 0 && filter->s2 == value && filter->output == value;
  @ behavior refused:
  @   assumes !filter_input(value);
  @   assigns \nothing;
  @   ensures FLT_004_refused: \result == KEEL_ERR_INPUT;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_filter_reset(keel_filter_t *filter, float value);

/*@ requires \valid(filter);
  @ requires filter_valid(*filter);
  @ assigns filter->s1, filter->s2, filter->output;
  @ ensures FLT_005_status: \result == KEEL_OK || \result == KEEL_ERR_INPUT;
  @ ensures FLT_005_bounded: filter_valid(*filter);
  @ ensures FLT_009_output: \result == KEEL_OK ==> filter->output ==
  @     (float)(\old(filter->s2) + (float)((float)(filter->b * \old(filter->s1))
  @         + (float)(filter->a * (float)(input - \old(filter->s2)))));
  @ ensures FLT_009_s1: \result == KEEL_OK ==> filter->s1 ==
  @     (float)((float)(filter->c * \old(filter->s1))
  @         + (float)(filter->b * (float)(input - \old(filter->s2))));
  @ ensures FLT_006_input: \result == KEEL_OK ==> filter_input(input);
  @ ensures FLT_006_held: \result == KEEL_ERR_INPUT ==> filter->s1 == \old(filter->s1) &&
  @     filter->s2 == \old(filter->s2) && filter->output == \old(filter->output);
  @*/
keel_status_t keel_filter_step(keel_filter_t *filter, float input);

KEEL_C_END

#endif
