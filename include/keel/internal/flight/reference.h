/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/reference.h
 * @brief The contracts of reference.h, as the provers read them.
 *
 * For every configuration that is taken and every bit pattern of the sticks, a set-point is within
 * its limit; exactly 0, and that +0, within the dead band, and only there; odd in its stick bit for
 * bit (up to the sign of 0, and for the climb rate up to its two limits); monotone in its stick as
 * floats; exactly the limit at the stick's end. This is proved of each operation, as rounded, and
 * put together by hand (specs/soundness.md); that a step computes these operations, bit for bit, is
 * proved. Sticks that are not finite or beyond 1 are refused with KEEL_ERR_INPUT, all four: every
 * set-point stays what it was.
 */
#ifndef KEEL_INTERNAL_FLIGHT_REFERENCE_H
#define KEEL_INTERNAL_FLIGHT_REFERENCE_H

#include "keel/c_declarations.h"
#include "keel/flight/reference.h"

KEEL_C_BEGIN

/*@ predicate reference_between(float value, real least, real greatest) =
  @     \is_finite(value) && least <= value <= greatest;
  @
  @ predicate reference_expo(keel_reference_shape_t shape) =
  @     reference_between(shape.expo, 0, KEEL_REFERENCE_EXPO_MAX);
  @
  @ predicate reference_expos(keel_reference_config_t config) =
  @     reference_expo(config.roll) && reference_expo(config.pitch) &&
  @     reference_expo(config.yaw) && reference_expo(config.climb);
  @
  @ predicate reference_dead_band(keel_reference_shape_t shape) =
  @     reference_between(shape.dead_band, KEEL_REFERENCE_DEAD_BAND_MIN,
  @         KEEL_REFERENCE_DEAD_BAND_MAX);
  @
  @ predicate reference_dead_bands(keel_reference_config_t config) =
  @     reference_dead_band(config.roll) && reference_dead_band(config.pitch) &&
  @     reference_dead_band(config.yaw) && reference_dead_band(config.climb);
  @
  @ predicate reference_limit(float limit, real greatest) =
  @     reference_between(limit, KEEL_REFERENCE_LIMIT_MIN, greatest);
  @
  @ predicate reference_limits(keel_reference_limits_t limits) =
  @     reference_limit(limits.roll_rate, KEEL_REFERENCE_RATE_MAX) &&
  @     reference_limit(limits.pitch_rate, KEEL_REFERENCE_RATE_MAX) &&
  @     reference_limit(limits.yaw_rate, KEEL_REFERENCE_RATE_MAX) &&
  @     reference_limit(limits.heading_rate, KEEL_REFERENCE_RATE_MAX) &&
  @     reference_limit(limits.tilt, KEEL_REFERENCE_TILT_MAX) &&
  @     reference_limit(limits.speed, KEEL_REFERENCE_SPEED_MAX) &&
  @     reference_limit(limits.climb_rate, KEEL_REFERENCE_SPEED_MAX) &&
  @     reference_limit(limits.descent_rate, KEEL_REFERENCE_SPEED_MAX);
  @
  @ // A step needs this of a curve; the end is reached: REF-003 has it.
  @ predicate reference_curve(keel_reference_curve_t curve) =
  @     reference_between(curve.dead_band, KEEL_REFERENCE_DEAD_BAND_MIN,
  @         KEEL_REFERENCE_DEAD_BAND_MAX) &&
  @     reference_between(curve.scale, 1, 2.5) && reference_between(curve.linear, 0, 1) &&
  @     reference_between(curve.expo, 0, 1) && curve.linear == (float)(1 - curve.expo);
  @
  @ // Init establishes this, and every step keeps it.
  @ predicate reference_valid(keel_reference_t reference) =
  @     reference_curve(reference.roll) && reference_curve(reference.pitch) &&
  @     reference_curve(reference.yaw) && reference_curve(reference.climb) &&
  @     reference_limits(reference.limits);
  @
  @ predicate reference_stick(float stick) = reference_between(stick, -1, 1);
  @
  @ predicate reference_sticks(keel_reference_sticks_t sticks) =
  @     reference_stick(sticks.roll) && reference_stick(sticks.pitch) &&
  @     reference_stick(sticks.yaw) && reference_stick(sticks.climb);
  @
  @ // u, a stick's deflection, and what is left of one beside that across: the formulas above,
  @ // rounded after each operation.
  @ logic float reference_stretched(keel_reference_curve_t curve, float stick) = (float)(
  @     (float)((stick < 0 ? -stick : stick) - curve.dead_band) * curve.scale);
  @
  @ logic float reference_u(keel_reference_curve_t curve, float stick) = (float)\min(1,
  @     \max(0, reference_stretched(curve, stick)));
  @
  @ logic float reference_bent(keel_reference_curve_t curve, float u) = (float)(
  @     u * (float)(curve.linear + (float)(curve.expo * (float)(u * u))));
  @
  @ logic float reference_deflection(keel_reference_curve_t curve, float stick) = (float)(
  @     stick < 0 ? -reference_bent(curve, reference_u(curve, stick))
  @               : reference_bent(curve, reference_u(curve, stick)));
  @
  @ logic float reference_rounded_off(float own, float across) = (float)(
  @     own * (float)(1 - (float)(KEEL_REFERENCE_CORNER * (float)(across * across))));
  @
  @ // A limit makes this of a deflection.
  @ predicate reference_asked(float setpoint, float limit, float deflection) =
  @     setpoint == (float)(limit * deflection);
  @*/

/*@ requires \valid(reference) && \valid_read(config) && \separated(reference, config);
  @ assigns *reference;
  @ behavior bad_expo:
  @   assumes !reference_expos(*config);
  @   assigns \nothing;
  @   ensures REF_001_expo: \result == KEEL_ERR_GAIN;
  @ behavior bad_limit:
  @   assumes reference_expos(*config) &&
  @       !(reference_dead_bands(*config) && reference_limits(config->limits));
  @   assigns \nothing;
  @   ensures REF_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior made:
  @   assumes reference_expos(*config) && reference_dead_bands(*config) &&
  @       reference_limits(config->limits);
  @   ensures REF_002_ok: \result == KEEL_OK;
  @   ensures REF_002_valid: reference_valid(*reference);
  @   ensures REF_002_limits: reference->limits == config->limits;
  @   ensures REF_002_zero: reference->setpoints.roll_rate == 0 &&
  @       reference->setpoints.pitch_rate == 0 && reference->setpoints.yaw_rate == 0 &&
  @       reference->setpoints.heading_rate == 0 && reference->setpoints.roll == 0 &&
  @       reference->setpoints.pitch == 0 && reference->setpoints.forward == 0 &&
  @       reference->setpoints.right == 0 && reference->setpoints.climb_rate == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_reference_init(keel_reference_t *reference,
                                  const keel_reference_config_t *config);

/*@ requires \valid(reference) && \valid_read(sticks) && \separated(reference, sticks);
  @ requires reference_valid(*reference);
  @ assigns reference->setpoints;
  @ behavior refused:
  @   assumes !reference_sticks(*sticks);
  @   assigns \nothing;
  @   ensures REF_004_refused: \result == KEEL_ERR_INPUT;
  @ behavior taken:
  @   assumes reference_sticks(*sticks);
  @   ensures REF_004_ok: \result == KEEL_OK;
  @   ensures REF_005_rates:
  @     reference_asked(reference->setpoints.roll_rate, reference->limits.roll_rate,
  @         reference_deflection(reference->roll, sticks->roll)) &&
  @     reference_asked(reference->setpoints.pitch_rate, reference->limits.pitch_rate,
  @         reference_deflection(reference->pitch, sticks->pitch)) &&
  @     reference_asked(reference->setpoints.yaw_rate, reference->limits.yaw_rate,
  @         reference_deflection(reference->yaw, sticks->yaw)) &&
  @     reference_asked(reference->setpoints.heading_rate, reference->limits.heading_rate,
  @         reference_deflection(reference->yaw, sticks->yaw));
  @   ensures REF_005_angles:
  @     reference_asked(reference->setpoints.roll, reference->limits.tilt, reference_rounded_off(
  @         reference_deflection(reference->roll, sticks->roll),
  @         reference_deflection(reference->pitch, sticks->pitch))) &&
  @     reference_asked(reference->setpoints.pitch, reference->limits.tilt, reference_rounded_off(
  @         reference_deflection(reference->pitch, sticks->pitch),
  @         reference_deflection(reference->roll, sticks->roll)));
  @   ensures REF_005_climb:
  @     reference_asked(reference->setpoints.climb_rate,
  @         sticks->climb < 0 ? reference->limits.descent_rate : reference->limits.climb_rate,
  @         reference_deflection(reference->climb, sticks->climb));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_reference_step(keel_reference_t *reference,
                                  const keel_reference_sticks_t *sticks);

KEEL_C_END

#endif
