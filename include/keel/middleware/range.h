/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file range.h
 * @brief Whether a float lies in a range, and the float of a range that is next to it.
 *
 * The one place where Keel tells numbers from NaN and infinities. Every comparison with NaN is
 * false, so that NaN lies in no range; clamped, it becomes the lower end. The functions are inline
 * because they stand in the hot paths of the voter, the filter and the controller.
 */
#ifndef KEEL_MIDDLEWARE_RANGE_H
#define KEEL_MIDDLEWARE_RANGE_H

#include "keel/c_declarations.h"

#include <stdbool.h>

KEEL_C_BEGIN

/** The largest finite float: a value is finite when it lies between this and its negative. */
#define KEEL_RANGE_LARGEST 0x1.fffffep+127f

/*@ predicate range_contains(float value, real lowest, real highest) =
  @     \is_finite(value) && lowest <= value <= highest;
  @*/

/**
 * Whether a value lies in a range, its ends included (requirement RNG-001).
 *
 * @param value   any bit pattern
 * @param lowest  the lower end, finite
 * @param highest the upper end, finite
 * @return false for NaN, too
 */
/*@ requires \is_finite(lowest) && \is_finite(highest);
  @ assigns \nothing;
  @ ensures RNG_001: \result <==> range_contains(value, lowest, highest);
  @*/
static inline bool keel_range_contains(float value, float lowest, float highest)
{
    return (value >= lowest) && (value <= highest);
}

/**
 * The value of a range that is next to a given one (requirement RNG-002).
 *
 * @param value   any bit pattern
 * @param lowest  the lower end, finite
 * @param highest the upper end, finite, not below the lower
 * @return the value itself when it lies in the range, else the end that is next to it; the lower
 *         end for NaN
 */
/*@ requires \is_finite(lowest) && \is_finite(highest) && lowest <= highest;
  @ assigns \nothing;
  @ ensures RNG_002_range: range_contains(\result, lowest, highest);
  @ ensures RNG_002_within: range_contains(value, lowest, highest) ==> \result == value;
  @ ensures RNG_002_below: (\is_finite(value) && value < lowest) || \is_NaN(value) ==>
  @     \result == lowest;
  @ ensures RNG_002_above: \is_finite(value) && value > highest ==> \result == highest;
  @*/
static inline float keel_range_clamp(float value, float lowest, float highest)
{
    const float above = (value > lowest) ? value : lowest;

    return (above < highest) ? above : highest;
}

KEEL_C_END

#endif
