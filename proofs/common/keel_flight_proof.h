/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file keel_flight_proof.h
 * @brief What the CBMC harnesses of the flight layer share: arbitrary numbers and valid filters.
 *
 * An arbitrary number is any bit pattern, NaN and infinities included. Comparisons are those of
 * IEEE 754: none holds for a NaN, so that `lo <= x && x <= hi` implies a finite x.
 */
#ifndef KEEL_FLIGHT_PROOF_H
#define KEEL_FLIGHT_PROOF_H

#include "keel/flight/filter.h"
#include "same.h"

#include <stdbool.h>

bool nondet_bool(void);
unsigned char nondet_u8(void);
float nondet_float(void);
keel_filter_t nondet_filter(void);

static bool within(float value, float least, float greatest)
{
    return (least <= value) && (value <= greatest);
}

/* A number between two bounds. */
static float any_within(float least, float greatest)
{
    const float value = nondet_float();

    __CPROVER_assume(within(value, least, greatest));
    return value;
}

static bool filter_input_here(float value)
{
    return within(value, -KEEL_FILTER_INPUT_LIMIT, KEEL_FILTER_INPUT_LIMIT);
}

static bool magnitude(float value, float most)
{
    return within(value, -most, most);
}

static bool filter_coefficients_here(const keel_filter_t *filter)
{
    return magnitude(filter->a, 2.0f) && magnitude(filter->b, 2.0f) && magnitude(filter->c, 2.0f);
}

static bool filter_bounded_by(const keel_filter_t *filter, float energy, float state, float output)
{
    return (filter->energy_limit == energy) && magnitude(filter->s1, state) &&
           magnitude(filter->s2, state) && magnitude(filter->output, output);
}

static bool filter_bounded_here(const keel_filter_t *filter)
{
    return filter_bounded_by(filter, KEEL_FILTER_LOW_ENERGY_LIMIT, KEEL_FILTER_LOW_STATE_LIMIT,
                             KEEL_FILTER_LOW_OUTPUT_LIMIT) ||
           filter_bounded_by(filter, KEEL_FILTER_HIGH_ENERGY_LIMIT, KEEL_FILTER_HIGH_STATE_LIMIT,
                             KEEL_FILTER_HIGH_OUTPUT_LIMIT);
}

static bool filter_same(const keel_filter_t *x, const keel_filter_t *y)
{
    return float_same(x->a, y->a) && float_same(x->b, y->b) && float_same(x->c, y->c) &&
           float_same(x->energy_limit, y->energy_limit) && float_same(x->s1, y->s1) &&
           float_same(x->s2, y->s2) && float_same(x->output, y->output);
}

/* Any valid filter (filter_valid). Its energy limit is one of two by construction, not by an
 * assumption: the solver then knows all of its bits but one. */
static void any_filter(keel_filter_t *filter)
{
    *filter = nondet_filter();
    filter->energy_limit = nondet_bool() ? KEEL_FILTER_LOW_ENERGY_LIMIT
                                         : KEEL_FILTER_HIGH_ENERGY_LIMIT;
    __CPROVER_assume(filter_coefficients_here(filter) && filter_bounded_here(filter));
}

#endif
