/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/filter.h"

#include "keel/middleware/range.h"

#include <stdbool.h>

/*@ assigns \nothing;
  @ ensures \result <==> filter_input(value);
  @*/
static bool is_sample(float value)
{
    return keel_range_contains(value, -KEEL_FILTER_INPUT_LIMIT, KEEL_FILTER_INPUT_LIMIT);
}

/* tan(pi ratio) for a ratio up to 1/4: the continued fraction of the tangent to its fifth term,
 * which is off by 1.4e-8 at most (at 1/4). */
/*@ assigns \nothing; */
static float tangent(float ratio)
{
    const float pi = 3.1415927410125732421875f; /* to single precision, written out */
    const float angle = pi * ratio;
    const float square = angle * angle;

    return (angle * (945.0f - (square * (105.0f - square)))) /
           (945.0f - (square * (420.0f - (15.0f * square))));
}

/* For a cut-off up to a quarter of the rate t is g, and 1 / g above: never far above 1, so that no
 * product grows. With D' = 1 + sqrt(2) t + t^2 the parts 1 / D' and t^2 / D' change places there.
 * The difference is exact, since the ratio is at least 1/4. */
/*@ requires \valid(filter);
  @ assigns filter->a, filter->b, filter->c, filter->energy_limit;
  @*/
static void set_coefficients(keel_filter_t *filter, float ratio)
{
    const float sqrt_2 = 1.41421353816986083984375f; /* to single precision, written out */
    const bool low = ratio <= 0.25f;
    const float t = tangent(low ? ratio : (0.5f - ratio));
    const float constant = 1.0f / (1.0f + (t * (t + sqrt_2)));
    const float square = (t * constant) * t;

    filter->a = low ? square : constant;
    filter->b = (t * constant) * sqrt_2;
    filter->c = (2.0f * (low ? constant : square)) - 1.0f;
    filter->energy_limit = low ? KEEL_FILTER_LOW_ENERGY_LIMIT : KEEL_FILTER_HIGH_ENERGY_LIMIT;
}

keel_status_t keel_filter_init(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    if (!keel_range_contains(rate_hz, KEEL_FILTER_RATE_MIN_HZ, KEEL_FILTER_RATE_MAX_HZ)) {
        return KEEL_ERR_RATE;
    }
    if (!((cutoff_hz >= (rate_hz * KEEL_FILTER_RATIO_MIN)) && (cutoff_hz < (rate_hz * 0.5f)))) {
        return KEEL_ERR_CUTOFF;
    }
    set_coefficients(filter, cutoff_hz / rate_hz);
    filter->s1 = 0.0f;
    filter->s2 = 0.0f;
    filter->output = 0.0f;
    return KEEL_OK;
}

keel_status_t keel_filter_reset(keel_filter_t *filter, float value)
{
    if (!is_sample(value)) {
        return KEEL_ERR_INPUT;
    }
    filter->s1 = 0.0f;
    filter->s2 = value;
    filter->output = value;
    return KEEL_OK;
}

keel_status_t keel_filter_step(keel_filter_t *filter, float input)
{
    float difference;
    float half_rise;
    float output;
    float s1;
    float s2;

    if (!is_sample(input)) {
        return KEEL_ERR_INPUT;
    }
    difference = input - filter->s2;
    half_rise = (filter->b * filter->s1) + (filter->a * difference);
    output = filter->s2 + half_rise;
    s1 = (filter->c * filter->s1) + (filter->b * difference);
    s2 = output + half_rise;
    if (!(((s1 * s1) + (s2 * s2)) <= filter->energy_limit)) {
        return KEEL_ERR_INPUT;
    }
    filter->s1 = s1;
    filter->s2 = s2;
    filter->output = output;
    return KEEL_OK;
}
