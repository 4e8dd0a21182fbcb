/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file filter.h
 * @brief Two-pole Butterworth low-pass: what the derivative of eq. 4 is taken from.
 *
 * The filter is the bilinear transform of H(s) = 1 / (s^2 + sqrt(2) s + 1), with the cut-off
 * prewarped, so that its gain there is 1/sqrt(2) whatever the sample rate. It is realised as a
 * state-variable filter of two trapezoidal integrators (topology-preserving transform), the first
 * one's state scaled by 1/sqrt(2), which makes both couplings equal:
 *
 *     g = tan(pi cutoff / rate),  D = 1 + sqrt(2) g + g^2
 *     a = g^2 / D,  b = sqrt(2) g / D,  c = 2 / D - 1
 *     d = x - s2,  h = b s1 + a d,  y = s2 + h           y is the output
 *     s1 <- c s1 + b d,  s2 <- y + h
 *
 * A constant input x is a fixed point (s1 = 0, s2 = x), however the coefficients are rounded: the
 * gain at 0 Hz is 1. With cut-offs far below the rate it loses fewer bits than the direct forms do:
 * what rounding adds grows as 2^-24 / g, there as 2^-24 / g^2.
 *
 * The states are bounded by construction: an input that is not finite or beyond
 * KEEL_FILTER_INPUT_LIMIT is refused, and so is one that would lead to states with more energy
 * than the filter's limit. A refused input changes nothing. In exact arithmetic the second never
 * happens: inputs up to M lead to |(s1, s2)| < 1.45 M (1 + g) at most (requirement FLT-008), which
 * is well below the limit for the greatest M.
 *
 * Single precision throughout. Sources must be compiled without contraction of products and sums
 * (ISO C mode, -std=c99, as all builds of Keel do).
 */
#ifndef KEEL_FLIGHT_FILTER_H
#define KEEL_FLIGHT_FILTER_H

#include "keel/c_declarations.h"
#include "keel/status.h"

KEEL_C_BEGIN

/** Sample rates, in Hz; the least is 2^-10. */
#define KEEL_FILTER_RATE_MIN_HZ 0.0009765625f
#define KEEL_FILTER_RATE_MAX_HZ 1.0e6f

/** The least cut-off, as a part of the sample rate: 2^-20, below which single precision can no
 * longer follow. */
#define KEEL_FILTER_RATIO_MIN 9.5367431640625e-7f

/** The greatest input, in the input's unit. */
#define KEEL_FILTER_INPUT_LIMIT 1.0e6f

/** The bound of a state: with a cut-off up to a quarter of the rate 2^22, else 2^45. */
#define KEEL_FILTER_LOW_STATE_LIMIT  4194304.0f
#define KEEL_FILTER_HIGH_STATE_LIMIT 35184372088832.0f

/** The bound of an output, whatever the inputs: eight times the limit of a state. In exact
 * arithmetic inputs up to M lead to less than 2.5 M, and to less than 1.3 M with cut-offs up to a
 * quarter of the rate. */
#define KEEL_FILTER_LOW_OUTPUT_LIMIT  33554432.0f
#define KEEL_FILTER_HIGH_OUTPUT_LIMIT 281474976710656.0f

/** The squares of the states' limits. */
#define KEEL_FILTER_LOW_ENERGY_LIMIT  17592186044416.0f
#define KEEL_FILTER_HIGH_ENERGY_LIMIT 1237940039285380274899124224.0f

/** A filter: its coefficients, its state and its last output. */
typedef struct keel_filter {
    float a;            /**< g^2 / D, from 0 to 1. */
    float b;            /**< sqrt(2) g / D, from 0 to 0.415. */
    float c;            /**< 2 / D - 1, from -1 to 1. */
    float energy_limit; /**< The bound of s1^2 + s2^2, one of the two above. */
    float s1;           /**< First integrator (band-pass). */
    float s2;           /**< Second integrator (low-pass). */
    float output;       /**< The last output, in the input's unit. */
} keel_filter_t;

/**
 * Makes a filter, at rest at 0 (requirements FLT-001 to FLT-003).
 *
 * The tangent is computed here, by a rational approximation whose relative error is at most 2^-20
 * (tested over its range): no library call, neither here nor in a step.
 *
 * @param filter    the filter
 * @param rate_hz   how often it will be stepped, KEEL_FILTER_RATE_MIN_HZ to
 *                  KEEL_FILTER_RATE_MAX_HZ, in Hz
 * @param cutoff_hz the frequency at which the gain is 1/sqrt(2): less than half of rate_hz, and at
 *                  least KEEL_FILTER_RATIO_MIN of it, in Hz
 * @return KEEL_OK; KEEL_ERR_RATE or KEEL_ERR_CUTOFF when one is not as said, NaN included: then
 *         nothing is changed
 */
keel_status_t keel_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz);

/**
 * Puts a filter to rest at a value, as if that had been its input for ever (requirement FLT-004).
 *
 * @param filter the filter
 * @param value  the value, up to KEEL_FILTER_INPUT_LIMIT
 * @return KEEL_OK, or KEEL_ERR_INPUT when the value is not finite or beyond the limit: then nothing
 *         is changed
 */
keel_status_t keel_filter_reset(keel_filter_t *filter, float value);

/**
 * Filters one sample; the result is filter->output (requirements FLT-005 to FLT-009).
 *
 * @param filter the filter
 * @param input  the sample, any bit pattern
 * @return KEEL_OK; KEEL_ERR_INPUT when the input is not finite, beyond KEEL_FILTER_INPUT_LIMIT, or
 *         would take the states beyond their energy limit: then nothing is changed, the output is
 *         the last one
 */
keel_status_t keel_filter_step(keel_filter_t *filter, float input);

KEEL_C_END

#endif
