/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file altitude_proof.h
 * @brief What the harnesses of the altitude estimator share: arbitrary estimators, and when two are
 *        the same.
 */
#ifndef ALTITUDE_PROOF_H
#define ALTITUDE_PROOF_H

#include "../axis/axis_proof.h"
#include "keel/flight/altitude.h"

#include <stdbool.h>

keel_altitude_t nondet_altitude(void);
keel_altitude_sample_t nondet_altitude_sample(void);

static bool altitude_same(const keel_altitude_t *a, const keel_altitude_t *b)
{
    return axis_same(&a->axis, &b->axis) && float_same(a->reference, b->reference) &&
           float_same(a->zero, b->zero) && float_same(a->height, b->height) &&
           (a->has_reference == b->has_reference);
}

static bool altitude_sample_same(const keel_altitude_sample_t *a, const keel_altitude_sample_t *b)
{
    return float_same(a->pressure, b->pressure) && float_same(a->acceleration, b->acceleration) &&
           (a->has_pressure == b->has_pressure) && (a->has_acceleration == b->has_acceleration);
}

/* Any estimator at all. */
static keel_altitude_t any_altitude_at_all(void)
{
    keel_altitude_t altitude = nondet_altitude();

    altitude.axis = any_axis_at_all();
    altitude.has_reference = nondet_bool();
    return altitude;
}

/* Any bit pattern for all that was measured. */
static keel_altitude_sample_t any_altitude_sample(void)
{
    keel_altitude_sample_t sample = nondet_altitude_sample();

    sample.has_pressure = nondet_bool();
    sample.has_acceleration = nondet_bool();
    return sample;
}

static bool is_pressure(float pressure)
{
    return within(pressure, KEEL_ALTITUDE_PRESSURE_MIN, KEEL_ALTITUDE_PRESSURE_MAX);
}

/* What init establishes and every step keeps. */
static bool altitude_valid(const keel_altitude_t *altitude)
{
    return axis_valid(&altitude->axis) &&
           (!altitude->has_reference || is_pressure(altitude->reference)) &&
           within(altitude->zero, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           within(altitude->height, -2.0f * KEEL_AXIS_POSITION_LIMIT,
                  2.0f * KEEL_AXIS_POSITION_LIMIT);
}

#endif
