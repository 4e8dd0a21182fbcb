/* SPDX-License-Identifier: Apache-2.0 */
#include "filter.h"

#include <stdbool.h>

static bool sample_valid(float value)
{
    return (value >= -KEEL_FILTER_INPUT_LIMIT) && (value <= KEEL_FILTER_INPUT_LIMIT);
}

/* tan x for x up to pi / 4: x / (1 - x^2 / (3 - x^2 / (5 - x^2 / (7 - x^2 / 9)))), as one
 * quotient. */
static float tan_of(float x)
{
    const float x2 = x * x;

    return (x * (945.0f - (x2 * (105.0f - x2)))) / (945.0f - (x2 * (420.0f - (15.0f * x2))));
}

keel_status_t model_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    const float pi = 3.1415927410125732421875f;
    const float sqrt_2 = 1.41421353816986083984375f;
    float ratio;
    float t;
    float d;
    float t2;
    bool low;

    /* FLT-001: a refusal changes nothing. No comparison with NaN holds. */
    if (!((rate_hz >= KEEL_FILTER_RATE_MIN_HZ) && (rate_hz <= KEEL_FILTER_RATE_MAX_HZ))) {
        return KEEL_ERR_RATE;
    }
    if (!((cutoff_hz >= (rate_hz * KEEL_FILTER_RATIO_MIN)) && (cutoff_hz < (rate_hz * 0.5f)))) {
        return KEEL_ERR_CUTOFF;
    }
    /* FLT-002: with t = g, so that D is 1 + sqrt(2) t + t^2, a = t^2 / D, b = sqrt(2) t / D and
     * c = 2 / D - 1. Above a quarter of the rate t = 1 / g, and 1 and t^2 change places. */
    ratio = cutoff_hz / rate_hz;
    low = ratio <= 0.25f;
    t = tan_of(pi * (low ? ratio : (0.5f - ratio)));
    d = 1.0f / (1.0f + (t * (t + sqrt_2)));
    t2 = (t * d) * t;
    filter->a = low ? t2 : d;
    filter->b = (t * d) * sqrt_2;
    filter->c = (2.0f * (low ? d : t2)) - 1.0f;
    /* FLT-003: at rest at 0, with the bounds of its cut-off (FLT-005). */
    filter->energy_limit = low ? KEEL_FILTER_LOW_ENERGY_LIMIT : KEEL_FILTER_HIGH_ENERGY_LIMIT;
    filter->s1 = 0.0f;
    filter->s2 = 0.0f;
    filter->output = 0.0f;
    return KEEL_OK;
}

/* FLT-004: as if the value had been the input for ever. */
keel_status_t model_filter_reset(keel_filter_t *filter, float value)
{
    if (!sample_valid(value)) {
        return KEEL_ERR_INPUT;
    }
    filter->s1 = 0.0f;
    filter->s2 = value;
    filter->output = value;
    return KEEL_OK;
}

keel_status_t model_filter_step(keel_filter_t *filter, float input)
{
    /* FLT-009: the formulas of filter.h. */
    const float d = input - filter->s2;
    const float h = (filter->b * filter->s1) + (filter->a * d);
    const float y = filter->s2 + h;
    const float s1 = (filter->c * filter->s1) + (filter->b * d);
    const float s2 = y + h;

    /* FLT-006 and FLT-005: what is refused changes nothing. */
    if (!sample_valid(input)) {
        return KEEL_ERR_INPUT;
    }
    if (!(((s1 * s1) + (s2 * s2)) <= filter->energy_limit)) {
        return KEEL_ERR_INPUT;
    }
    filter->s1 = s1;
    filter->s2 = s2;
    filter->output = y;
    return KEEL_OK;
}
