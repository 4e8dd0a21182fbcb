/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/reference.h"

#include "keel/middleware/range.h"

#include <stdbool.h>

/*@ requires \valid_read(shape);
  @ assigns \nothing;
  @ ensures \result <==> reference_expo(*shape);
  @*/
static bool is_expo(const keel_reference_shape_t *shape)
{
    return keel_range_contains(shape->expo, 0.0f, KEEL_REFERENCE_EXPO_MAX);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> reference_expos(*config);
  @*/
static bool are_expos(const keel_reference_config_t *config)
{
    return is_expo(&config->roll) && is_expo(&config->pitch) && is_expo(&config->yaw) &&
           is_expo(&config->climb);
}

/*@ requires \valid_read(shape);
  @ assigns \nothing;
  @ ensures \result <==> reference_dead_band(*shape);
  @*/
static bool is_dead_band(const keel_reference_shape_t *shape)
{
    return keel_range_contains(shape->dead_band, KEEL_REFERENCE_DEAD_BAND_MIN,
                               KEEL_REFERENCE_DEAD_BAND_MAX);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> reference_dead_bands(*config);
  @*/
static bool are_dead_bands(const keel_reference_config_t *config)
{
    return is_dead_band(&config->roll) && is_dead_band(&config->pitch) &&
           is_dead_band(&config->yaw) && is_dead_band(&config->climb);
}

/*@ requires \is_finite(greatest);
  @ assigns \nothing;
  @ ensures \result <==> reference_limit(limit, greatest);
  @*/
static bool is_stick_limit(float limit, float greatest)
{
    return keel_range_contains(limit, KEEL_REFERENCE_LIMIT_MIN, greatest);
}

/*@ requires \valid_read(limits);
  @ assigns \nothing;
  @ ensures \result <==> reference_limits(*limits);
  @*/
static bool are_stick_limits(const keel_reference_limits_t *limits)
{
    return is_stick_limit(limits->roll_rate, KEEL_REFERENCE_RATE_MAX) &&
           is_stick_limit(limits->pitch_rate, KEEL_REFERENCE_RATE_MAX) &&
           is_stick_limit(limits->yaw_rate, KEEL_REFERENCE_RATE_MAX) &&
           is_stick_limit(limits->heading_rate, KEEL_REFERENCE_RATE_MAX) &&
           is_stick_limit(limits->tilt, KEEL_REFERENCE_TILT_MAX) &&
           is_stick_limit(limits->speed, KEEL_REFERENCE_SPEED_MAX) &&
           is_stick_limit(limits->climb_rate, KEEL_REFERENCE_SPEED_MAX) &&
           is_stick_limit(limits->descent_rate, KEEL_REFERENCE_SPEED_MAX);
}

/* The only division, once for each stick. */
/*@ requires \valid_read(shape);
  @ assigns \nothing;
  @*/
static keel_reference_curve_t curve_of(const keel_reference_shape_t *shape)
{
    const keel_reference_curve_t curve = {
        .dead_band = shape->dead_band,
        .scale = (1.0f / (1.0f - shape->dead_band)) * KEEL_REFERENCE_REACH,
        .linear = 1.0f - shape->expo,
        .expo = shape->expo,
    };

    return curve;
}

keel_status_t keel_reference_init(keel_reference_t *reference,
                                  const keel_reference_config_t *config)
{
    if (!are_expos(config)) {
        return KEEL_ERR_GAIN;
    }
    if (!(are_dead_bands(config) && are_stick_limits(&config->limits))) {
        return KEEL_ERR_LIMITS;
    }
    reference->roll = curve_of(&config->roll);
    reference->pitch = curve_of(&config->pitch);
    reference->yaw = curve_of(&config->yaw);
    reference->climb = curve_of(&config->climb);
    reference->limits = config->limits;
    reference->setpoints.roll_rate = 0.0f;
    reference->setpoints.pitch_rate = 0.0f;
    reference->setpoints.yaw_rate = 0.0f;
    reference->setpoints.heading_rate = 0.0f;
    reference->setpoints.roll = 0.0f;
    reference->setpoints.pitch = 0.0f;
    reference->setpoints.forward = 0.0f;
    reference->setpoints.right = 0.0f;
    reference->setpoints.climb_rate = 0.0f;
    return KEEL_OK;
}

/*@ requires \valid_read(sticks);
  @ assigns \nothing;
  @ ensures \result <==> reference_sticks(*sticks);
  @*/
static bool are_sticks(const keel_reference_sticks_t *sticks)
{
    return keel_range_contains(sticks->roll, -1.0f, 1.0f) &&
           keel_range_contains(sticks->pitch, -1.0f, 1.0f) &&
           keel_range_contains(sticks->yaw, -1.0f, 1.0f) &&
           keel_range_contains(sticks->climb, -1.0f, 1.0f);
}

/* Clamped from below within the dead band, from above at the end. The opposite of a number is its
 * difference from 0 here and below: that of 0 is 0 then, not -0. */
/*@ requires \valid_read(curve);
  @ assigns \nothing;
  @*/
static float deflection(const keel_reference_curve_t *curve, float stick)
{
    const float size = (stick < 0.0f) ? -stick : stick;
    const float u = keel_range_clamp((size - curve->dead_band) * curve->scale, 0.0f, 1.0f);
    const float bent = u * (curve->linear + (curve->expo * (u * u)));

    return (stick < 0.0f) ? (0.0f - bent) : bent;
}

/* The part of a stick's deflection that counts, given that of the stick across. */
/*@ assigns \nothing; */
static float rounded_off(float own, float across)
{
    return own * (1.0f - (KEEL_REFERENCE_CORNER * (across * across)));
}

keel_status_t keel_reference_step(keel_reference_t *reference,
                                  const keel_reference_sticks_t *sticks)
{
    const keel_reference_limits_t *const limits = &reference->limits;
    keel_reference_setpoints_t *const setpoints = &reference->setpoints;
    float roll;
    float pitch;
    float yaw;
    float climb;
    float sideways;
    float lengthways;

    if (!are_sticks(sticks)) {
        return KEEL_ERR_INPUT;
    }
    roll = deflection(&reference->roll, sticks->roll);
    pitch = deflection(&reference->pitch, sticks->pitch);
    yaw = deflection(&reference->yaw, sticks->yaw);
    climb = deflection(&reference->climb, sticks->climb);
    sideways = rounded_off(roll, pitch);
    lengthways = rounded_off(pitch, roll);
    setpoints->roll_rate = limits->roll_rate * roll;
    setpoints->pitch_rate = limits->pitch_rate * pitch;
    setpoints->yaw_rate = limits->yaw_rate * yaw;
    setpoints->heading_rate = limits->heading_rate * yaw;
    setpoints->roll = limits->tilt * sideways;
    setpoints->pitch = limits->tilt * lengthways;
    setpoints->forward = 0.0f - (limits->speed * lengthways); /* nose down leads forwards */
    setpoints->right = limits->speed * sideways;
    setpoints->climb_rate = climb * ((climb < 0.0f) ? limits->descent_rate : limits->climb_rate);
    return KEEL_OK;
}
