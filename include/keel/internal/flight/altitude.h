/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/altitude.h
 * @brief The contracts of altitude.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_ALTITUDE_H
#define KEEL_INTERNAL_FLIGHT_ALTITUDE_H

#include "keel/c_declarations.h"
#include "keel/flight/altitude.h"
#include "keel/internal/flight/axis.h"

KEEL_C_BEGIN

/*@ predicate altitude_pressure(keel_altitude_sample_t *s) = s->has_pressure &&
  @     axis_number(s->pressure, KEEL_ALTITUDE_PRESSURE_MIN, KEEL_ALTITUDE_PRESSURE_MAX);
  @
  @ // Init establishes this and every step keeps it, besides its axis.
  @ predicate altitude_referenced(keel_altitude_t *a) = a->has_reference ==>
  @     axis_number(a->reference, KEEL_ALTITUDE_PRESSURE_MIN, KEEL_ALTITUDE_PRESSURE_MAX);
  @*/

/*@ requires \valid(altitude) && \valid_read(config) && \separated(altitude, config);
  @ assigns *altitude;
  @ ensures ALT_001_rate: !axis_rate(*config) ==> \result == KEEL_ERR_RATE;
  @ ensures ALT_001_gains: axis_rate(*config) && !axis_gains(*config) ==>
  @     \result == KEEL_ERR_GAIN;
  @ ensures ALT_001_limits: axis_rate(*config) && axis_gains(*config) && !axis_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures ALT_001_kept: \result != KEEL_OK ==> *altitude == \old(*altitude);
  @ ensures ALT_002_taken: axis_rate(*config) && axis_gains(*config) && axis_limits(*config) ==>
  @     \result == KEEL_OK && altitude->axis.config == *config && axis_limited(&altitude->axis);
  @ ensures ALT_002_unknown: \result == KEEL_OK ==> altitude->axis.quality == KEEL_AXIS_NONE &&
  @     !altitude->has_reference && altitude->height == 0;
  @*/
keel_status_t keel_altitude_init(keel_altitude_t *altitude, const keel_axis_config_t *config);

/*@ requires \valid(altitude);
  @ assigns altitude->zero, altitude->height;
  @ ensures ALT_003_zero: altitude->height == 0;
  @ ensures ALT_003_here: \is_finite(altitude->axis.position) ==>
  @     altitude->zero == altitude->axis.position;
  @*/
void keel_altitude_zero(keel_altitude_t *altitude);

/*@ requires \valid(altitude) && \valid_read(sample) && \separated(altitude, sample);
  @ requires axis_limited(&altitude->axis) && altitude_referenced(altitude);
  @ assigns altitude->axis.position, altitude->axis.velocity, altitude->axis.bias,
  @     altitude->axis.jump, altitude->axis.age, altitude->axis.agreed, altitude->axis.jumped,
  @     altitude->axis.flags, altitude->axis.quality, altitude->reference,
  @     altitude->height, altitude->has_reference;
  @ ensures ALT_004_first: !\old(altitude->has_reference) && altitude_pressure(sample) ==>
  @     altitude->has_reference && altitude->reference == sample->pressure;
  @ ensures ALT_004_kept: \old(altitude->has_reference) || !altitude_pressure(sample) ==>
  @     altitude->has_reference == \old(altitude->has_reference) &&
  @     (altitude->has_reference ==> altitude->reference == \old(altitude->reference));
  @ ensures ALT_004_pressure: altitude_referenced(altitude);
  @ ensures ALT_005_unusable: axis_told(&altitude->axis, KEEL_AXIS_UNUSABLE) <==>
  @     sample->has_pressure && !altitude_pressure(sample);
  @ ensures ALT_005_counts: altitude_pressure(sample) <==>
  @     (axis_told(&altitude->axis, KEEL_AXIS_FIXED) ||
  @     axis_told(&altitude->axis, KEEL_AXIS_JUMPED));
  @ ensures ALT_006_position: axis_number(altitude->axis.position, -KEEL_AXIS_POSITION_LIMIT,
  @     KEEL_AXIS_POSITION_LIMIT);
  @ ensures ALT_006_velocity: axis_number(altitude->axis.velocity, -KEEL_AXIS_VELOCITY_LIMIT,
  @     KEEL_AXIS_VELOCITY_LIMIT);
  @ ensures ALT_006_height:
  @     axis_number(altitude->zero, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) ==>
  @     axis_number(altitude->height, -2 * KEEL_AXIS_POSITION_LIMIT,
  @         2 * KEEL_AXIS_POSITION_LIMIT) &&
  @     altitude->height == (float)(altitude->axis.position - altitude->zero);
  @*/
void keel_altitude_step(keel_altitude_t *altitude, const keel_altitude_sample_t *sample);

KEEL_C_END

#endif
