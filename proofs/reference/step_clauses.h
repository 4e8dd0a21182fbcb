/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file step_clauses.h
 * @brief The formulas of a step's contract, rounded after each operation. Set-points are
 *        compared bit for bit.
 */
#ifndef STEP_CLAUSES_H
#define STEP_CLAUSES_H

#include "reference_proof.h"

static float stretched_of(const keel_reference_curve_t *curve, float stick)
{
    return (((stick < 0.0f) ? -stick : stick) - curve->dead_band) * curve->scale;
}

static float u_of(const keel_reference_curve_t *curve, float stick)
{
    const float stretched = stretched_of(curve, stick);
    const float above = (stretched > 0.0f) ? stretched : 0.0f;

    return (above < 1.0f) ? above : 1.0f;
}

static float bent_of(const keel_reference_curve_t *curve, float u)
{
    return u * (curve->linear + (curve->expo * (u * u)));
}

/* The opposite of a number is its difference from 0: that of 0 is 0. */
static float deflection_of(const keel_reference_curve_t *curve, float stick)
{
    const float bent = bent_of(curve, u_of(curve, stick));

    return (stick < 0.0f) ? (0.0f - bent) : bent;
}

static float rounded_off_of(float own, float across)
{
    return own * (1.0f - (KEEL_REFERENCE_CORNER * (across * across)));
}

static bool is_asked(float setpoint, float limit, float deflection)
{
    return float_same(setpoint, limit * deflection);
}

static bool are_rates(const keel_reference_t *reference, const keel_reference_sticks_t *sticks)
{
    const keel_reference_setpoints_t *const asked = &reference->setpoints;
    const keel_reference_limits_t *const limits = &reference->limits;

    return is_asked(asked->roll_rate, limits->roll_rate,
                    deflection_of(&reference->roll, sticks->roll)) &&
           is_asked(asked->pitch_rate, limits->pitch_rate,
                    deflection_of(&reference->pitch, sticks->pitch)) &&
           is_asked(asked->yaw_rate, limits->yaw_rate,
                    deflection_of(&reference->yaw, sticks->yaw)) &&
           is_asked(asked->heading_rate, limits->heading_rate,
                    deflection_of(&reference->yaw, sticks->yaw));
}

static bool are_angles(const keel_reference_t *reference, const keel_reference_sticks_t *sticks)
{
    const float roll = deflection_of(&reference->roll, sticks->roll);
    const float pitch = deflection_of(&reference->pitch, sticks->pitch);

    return is_asked(reference->setpoints.roll, reference->limits.tilt,
                    rounded_off_of(roll, pitch)) &&
           is_asked(reference->setpoints.pitch, reference->limits.tilt,
                    rounded_off_of(pitch, roll));
}

#endif
