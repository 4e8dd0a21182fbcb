/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file filter_contracts.h
 * @brief The contracts of the low-pass's functions, for CBMC: what their own harnesses prove, and
 *        what stands in for them where code that calls them is proved.
 */
#ifndef FILTER_CONTRACTS_H
#define FILTER_CONTRACTS_H

#include "keel_flight_proof.h"

static bool filter_valid_here(const keel_filter_t *filter)
{
    return filter_coefficients_here(filter) && filter_bounded_here(filter);
}

static bool filter_made_as_before(const keel_filter_t *filter, const keel_filter_t *before)
{
    return float_same(filter->a, before->a) && float_same(filter->b, before->b) &&
           float_same(filter->c, before->c) &&
           float_same(filter->energy_limit, before->energy_limit);
}

static bool keel_filter_init_may(void)
{
    return true;
}

static bool keel_filter_init_does(keel_status_t status, const keel_filter_t *filter,
                                  const keel_filter_t *before, float rate_hz)
{
    const bool made = (status == KEEL_OK) && filter_valid_here(filter) &&
                      within(rate_hz, KEEL_FILTER_RATE_MIN_HZ, KEEL_FILTER_RATE_MAX_HZ);
    const bool refused = ((status == KEEL_ERR_RATE) || (status == KEEL_ERR_CUTOFF)) &&
                         filter_same(filter, before);

    return made || refused;
}

static bool keel_filter_reset_may(const keel_filter_t *filter)
{
    return filter_valid_here(filter);
}

static bool keel_filter_reset_does(keel_status_t status, const keel_filter_t *filter,
                                   const keel_filter_t *before, float value)
{
    const bool reset = (status == KEEL_OK) && filter_input_here(value) &&
                       float_same(filter->output, value);
    const bool refused = (status == KEEL_ERR_INPUT) && filter_same(filter, before);

    return filter_valid_here(filter) && filter_made_as_before(filter, before) && (reset || refused);
}

static bool keel_filter_step_may(const keel_filter_t *filter)
{
    return filter_valid_here(filter);
}

static bool keel_filter_step_does(keel_status_t status, const keel_filter_t *filter,
                                  const keel_filter_t *before, float input)
{
    const bool stepped = (status == KEEL_OK) && filter_input_here(input);
    const bool refused = (status == KEEL_ERR_INPUT) && filter_same(filter, before);

    return filter_valid_here(filter) && filter_made_as_before(filter, before) &&
           (stepped || refused);
}

#endif
