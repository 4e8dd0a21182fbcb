/* SPDX-License-Identifier: Apache-2.0 */
#include "reference.h"

#include <stdbool.h>

/* No comparison with NaN holds. */
static bool is_between(float value, float least, float greatest)
{
    return (value >= least) && (value <= greatest);
}

static bool expo_valid(float expo)
{
    return is_between(expo, 0.0f, 1.0f);
}

static bool dead_band_valid(float dead_band)
{
    return is_between(dead_band, KEEL_REFERENCE_DEAD_BAND_MIN, KEEL_REFERENCE_DEAD_BAND_MAX);
}

static bool demand_valid(float limit, float greatest)
{
    return is_between(limit, KEEL_REFERENCE_LIMIT_MIN, greatest);
}

static bool demands_valid(const keel_reference_limits_t *limits)
{
    return demand_valid(limits->roll_rate, KEEL_REFERENCE_RATE_MAX) &&
           demand_valid(limits->pitch_rate, KEEL_REFERENCE_RATE_MAX) &&
           demand_valid(limits->yaw_rate, KEEL_REFERENCE_RATE_MAX) &&
           demand_valid(limits->heading_rate, KEEL_REFERENCE_RATE_MAX) &&
           demand_valid(limits->tilt, KEEL_REFERENCE_TILT_MAX) &&
           demand_valid(limits->speed, KEEL_REFERENCE_SPEED_MAX) &&
           demand_valid(limits->climb_rate, KEEL_REFERENCE_SPEED_MAX) &&
           demand_valid(limits->descent_rate, KEEL_REFERENCE_SPEED_MAX);
}

/* REF-003 */
static void set_curve(keel_reference_curve_t *curve, const keel_reference_shape_t *shape)
{
    curve->dead_band = shape->dead_band;
    curve->scale = (1.0f / (1.0f - shape->dead_band)) * KEEL_REFERENCE_REACH;
    curve->linear = 1.0f - shape->expo;
    curve->expo = shape->expo;
}

keel_status_t model_reference_init(keel_reference_t *reference,
                                   const keel_reference_config_t *config)
{
    /* REF-001: a refusal changes nothing. */
    if (!(expo_valid(config->roll.expo) && expo_valid(config->pitch.expo) &&
          expo_valid(config->yaw.expo) && expo_valid(config->climb.expo))) {
        return KEEL_ERR_GAIN;
    }
    if (!(dead_band_valid(config->roll.dead_band) && dead_band_valid(config->pitch.dead_band) &&
          dead_band_valid(config->yaw.dead_band) && dead_band_valid(config->climb.dead_band) &&
          demands_valid(&config->limits))) {
        return KEEL_ERR_LIMITS;
    }
    set_curve(&reference->roll, &config->roll);
    set_curve(&reference->pitch, &config->pitch);
    set_curve(&reference->yaw, &config->yaw);
    set_curve(&reference->climb, &config->climb);
    /* REF-002: until there are sticks, as if they were centred. */
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

/* REF-005: the formulas of reference.h. Not -0: 0 - 0 is +0. */
static float deflected(const keel_reference_curve_t *curve, float x)
{
    const float beyond = (((x < 0.0f) ? -x : x) - curve->dead_band) * curve->scale;
    const float from_0 = (beyond > 0.0f) ? beyond : 0.0f;
    const float u = (from_0 < 1.0f) ? from_0 : 1.0f;
    const float s = u * (curve->linear + (curve->expo * (u * u)));

    return (x < 0.0f) ? (0.0f - s) : s;
}

/* REF-010: s (1 - k t^2). */
static float in_disc(float s, float t)
{
    return s * (1.0f - (KEEL_REFERENCE_CORNER * (t * t)));
}

keel_status_t model_reference_step(keel_reference_t *reference,
                                   const keel_reference_sticks_t *sticks)
{
    const float roll = deflected(&reference->roll, sticks->roll);
    const float pitch = deflected(&reference->pitch, sticks->pitch);
    const float yaw = deflected(&reference->yaw, sticks->yaw);
    const float climb = deflected(&reference->climb, sticks->climb);

    /* REF-004: a refusal changes nothing. */
    if (!(is_between(sticks->roll, -1.0f, 1.0f) && is_between(sticks->pitch, -1.0f, 1.0f) &&
          is_between(sticks->yaw, -1.0f, 1.0f) && is_between(sticks->climb, -1.0f, 1.0f))) {
        return KEEL_ERR_INPUT;
    }
    reference->setpoints.roll_rate = reference->limits.roll_rate * roll;
    reference->setpoints.pitch_rate = reference->limits.pitch_rate * pitch;
    reference->setpoints.yaw_rate = reference->limits.yaw_rate * yaw;
    reference->setpoints.heading_rate = reference->limits.heading_rate * yaw;
    reference->setpoints.roll = reference->limits.tilt * in_disc(roll, pitch);
    reference->setpoints.pitch = reference->limits.tilt * in_disc(pitch, roll);
    reference->setpoints.forward = 0.0f - (reference->limits.speed * in_disc(pitch, roll));
    reference->setpoints.right = reference->limits.speed * in_disc(roll, pitch);
    reference->setpoints.climb_rate = climb * ((climb < 0.0f) ? reference->limits.descent_rate
                                                              : reference->limits.climb_rate);
    return KEEL_OK;
}
