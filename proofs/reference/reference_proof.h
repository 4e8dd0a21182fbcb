/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file reference_proof.h
 * @brief What the harnesses of the reference generator share: arbitrary valid ones.
 */
#ifndef REFERENCE_PROOF_H
#define REFERENCE_PROOF_H

#include "../common/keel_flight_proof.h"
#include "keel/flight/reference.h"

keel_reference_t nondet_reference(void);
keel_reference_config_t nondet_reference_config(void);
keel_reference_sticks_t nondet_sticks(void);

static bool curve_here(const keel_reference_curve_t *curve)
{
    return within(curve->dead_band, KEEL_REFERENCE_DEAD_BAND_MIN, KEEL_REFERENCE_DEAD_BAND_MAX) &&
           within(curve->scale, 1.0f, 2.5f) && within(curve->linear, 0.0f, 1.0f) &&
           within(curve->expo, 0.0f, 1.0f) && (curve->linear == (1.0f - curve->expo));
}

static bool limit_here(float limit, float greatest)
{
    return within(limit, KEEL_REFERENCE_LIMIT_MIN, greatest);
}

static bool limits_here(const keel_reference_limits_t *limits)
{
    return limit_here(limits->roll_rate, KEEL_REFERENCE_RATE_MAX) &&
           limit_here(limits->pitch_rate, KEEL_REFERENCE_RATE_MAX) &&
           limit_here(limits->yaw_rate, KEEL_REFERENCE_RATE_MAX) &&
           limit_here(limits->heading_rate, KEEL_REFERENCE_RATE_MAX) &&
           limit_here(limits->tilt, KEEL_REFERENCE_TILT_MAX) &&
           limit_here(limits->speed, KEEL_REFERENCE_SPEED_MAX) &&
           limit_here(limits->climb_rate, KEEL_REFERENCE_SPEED_MAX) &&
           limit_here(limits->descent_rate, KEEL_REFERENCE_SPEED_MAX);
}

static bool reference_valid_here(const keel_reference_t *reference)
{
    return curve_here(&reference->roll) && curve_here(&reference->pitch) &&
           curve_here(&reference->yaw) && curve_here(&reference->climb) &&
           limits_here(&reference->limits);
}

static bool sticks_here(const keel_reference_sticks_t *sticks)
{
    return magnitude(sticks->roll, 1.0f) && magnitude(sticks->pitch, 1.0f) &&
           magnitude(sticks->yaw, 1.0f) && magnitude(sticks->climb, 1.0f);
}

static bool curve_same(const keel_reference_curve_t *x, const keel_reference_curve_t *y)
{
    return float_same(x->dead_band, y->dead_band) && float_same(x->scale, y->scale) &&
           float_same(x->linear, y->linear) && float_same(x->expo, y->expo);
}

static bool limits_same(const keel_reference_limits_t *x, const keel_reference_limits_t *y)
{
    return float_same(x->roll_rate, y->roll_rate) && float_same(x->pitch_rate, y->pitch_rate) &&
           float_same(x->yaw_rate, y->yaw_rate) && float_same(x->heading_rate, y->heading_rate) &&
           float_same(x->tilt, y->tilt) && float_same(x->speed, y->speed) &&
           float_same(x->climb_rate, y->climb_rate) && float_same(x->descent_rate, y->descent_rate);
}

static bool setpoints_same(const keel_reference_setpoints_t *x, const keel_reference_setpoints_t *y)
{
    return float_same(x->roll_rate, y->roll_rate) && float_same(x->pitch_rate, y->pitch_rate) &&
           float_same(x->yaw_rate, y->yaw_rate) && float_same(x->heading_rate, y->heading_rate) &&
           float_same(x->roll, y->roll) && float_same(x->pitch, y->pitch) &&
           float_same(x->forward, y->forward) && float_same(x->right, y->right) &&
           float_same(x->climb_rate, y->climb_rate);
}

static bool reference_same(const keel_reference_t *x, const keel_reference_t *y)
{
    return curve_same(&x->roll, &y->roll) && curve_same(&x->pitch, &y->pitch) &&
           curve_same(&x->yaw, &y->yaw) && curve_same(&x->climb, &y->climb) &&
           limits_same(&x->limits, &y->limits) && setpoints_same(&x->setpoints, &y->setpoints);
}

static bool shape_same(const keel_reference_shape_t *x, const keel_reference_shape_t *y)
{
    return float_same(x->dead_band, y->dead_band) && float_same(x->expo, y->expo);
}

static bool config_same(const keel_reference_config_t *x, const keel_reference_config_t *y)
{
    return shape_same(&x->roll, &y->roll) && shape_same(&x->pitch, &y->pitch) &&
           shape_same(&x->yaw, &y->yaw) && shape_same(&x->climb, &y->climb) &&
           limits_same(&x->limits, &y->limits);
}

static bool sticks_same(const keel_reference_sticks_t *x, const keel_reference_sticks_t *y)
{
    return float_same(x->roll, y->roll) && float_same(x->pitch, y->pitch) &&
           float_same(x->yaw, y->yaw) && float_same(x->climb, y->climb);
}

#endif
