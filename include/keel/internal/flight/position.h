/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/position.h
 * @brief The contracts of position.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_POSITION_H
#define KEEL_INTERNAL_FLIGHT_POSITION_H

#include "keel/c_declarations.h"
#include "keel/flight/position.h"
#include "keel/internal/flight/axis.h"

KEEL_C_BEGIN

/*@ predicate position_accuracies(keel_position_config_t c) =
  @     axis_number(c.accuracy, 0, KEEL_POSITION_ACCURACY_LIMIT) &&
  @     axis_number(c.speed_accuracy, 0, KEEL_POSITION_SPEED_ACCURACY_LIMIT);
  @
  @ // Of an estimator, what a step needs.
  @ predicate position_limited(keel_position_t *p) =
  @     axis_limited(&p->north) && axis_limited(&p->east) &&
  @     \is_finite(p->config.accuracy) && \is_finite(p->config.speed_accuracy);
  @
  @ predicate position_origin(integer latitude, integer longitude) =
  @     -KEEL_POSITION_LATITUDE_LIMIT <= latitude <= KEEL_POSITION_LATITUDE_LIMIT &&
  @     -KEEL_POSITION_HALF_TURN <= longitude <= KEEL_POSITION_HALF_TURN;
  @*/

/*@ requires \valid(position) && \valid_read(config) && \separated(position, config);
  @ assigns *position;
  @ ensures POS_001_accuracies: !position_accuracies(*config) ==> \result == KEEL_ERR_LIMITS;
  @ ensures POS_001_rate: position_accuracies(*config) && !axis_rate(config->axis) ==>
  @     \result == KEEL_ERR_RATE;
  @ ensures POS_001_gains: position_accuracies(*config) && axis_rate(config->axis) &&
  @     !axis_gains(config->axis) ==> \result == KEEL_ERR_GAIN;
  @ ensures POS_001_limits: position_accuracies(*config) && axis_rate(config->axis) &&
  @     axis_gains(config->axis) && !axis_limits(config->axis) ==> \result == KEEL_ERR_LIMITS;
  @ ensures POS_001_kept: \result != KEEL_OK ==> *position == \old(*position);
  @ ensures POS_002_taken: axis_rate(config->axis) && axis_gains(config->axis) &&
  @     axis_limits(config->axis) && position_accuracies(*config) ==>
  @     \result == KEEL_OK && position->config == *config && position_limited(position);
  @ ensures POS_002_unknown: \result == KEEL_OK ==>
  @     !position->has_origin && position->quality == KEEL_AXIS_NONE;
  @*/
keel_status_t keel_position_init(keel_position_t *position, const keel_position_config_t *config);

/*@ requires \valid(position);
  @ assigns position->north.position, position->north.velocity, position->north.bias,
  @     position->north.jump, position->north.age, position->north.agreed, position->north.jumped,
  @     position->north.flags, position->north.quality, position->east.position,
  @     position->east.velocity, position->east.bias, position->east.jump, position->east.age,
  @     position->east.agreed, position->east.jumped, position->east.flags, position->east.quality,
  @     position->latitude, position->longitude, position->north_scale, position->east_scale,
  @     position->has_origin, position->quality;
  @ behavior refused:
  @   assumes !position_origin(latitude, longitude);
  @   assigns \nothing;
  @   ensures POS_003_refused: \result == KEEL_ERR_VALUE;
  @ behavior set:
  @   assumes position_origin(latitude, longitude);
  @   ensures POS_003_ok: \result == KEEL_OK;
  @   ensures POS_003_set: position->has_origin && position->latitude == latitude &&
  @       position->longitude == longitude;
  @   ensures POS_003_forgotten: position->quality == KEEL_AXIS_NONE &&
  @       position->north.quality == KEEL_AXIS_NONE && position->east.quality == KEEL_AXIS_NONE;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_position_set_origin(keel_position_t *position, int32_t latitude,
                                       int32_t longitude);

/*@ requires \valid(position) && \valid_read(sample) && \separated(position, sample);
  @ requires position_limited(position);
  @ assigns position->north.position, position->north.velocity, position->north.bias,
  @     position->north.jump, position->north.age, position->north.agreed, position->north.jumped,
  @     position->north.flags, position->north.quality, position->east.position,
  @     position->east.velocity, position->east.bias, position->east.jump, position->east.age,
  @     position->east.agreed, position->east.jumped, position->east.flags, position->east.quality,
  @     position->quality;
  @ ensures POS_005_unusable: sample->has_fix && !(sample->fix.is_valid && position->has_origin &&
  @     axis_number(sample->fix.accuracy, 0, position->config.accuracy)) ==>
  @     axis_told(&position->north, KEEL_AXIS_UNUSABLE) &&
  @     axis_told(&position->east, KEEL_AXIS_UNUSABLE);
  @ ensures POS_005_none: !sample->has_fix ==>
  @     !axis_told(&position->north, KEEL_AXIS_FIXED) &&
  @     !axis_told(&position->east, KEEL_AXIS_FIXED);
  @ ensures POS_008_north: axis_number(position->north.position, -KEEL_AXIS_POSITION_LIMIT,
  @     KEEL_AXIS_POSITION_LIMIT) && axis_number(position->north.velocity,
  @     -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
  @ ensures POS_008_east: axis_number(position->east.position, -KEEL_AXIS_POSITION_LIMIT,
  @     KEEL_AXIS_POSITION_LIMIT) && axis_number(position->east.velocity,
  @     -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
  @ ensures POS_009_worse: position->quality == (position->north.quality < position->east.quality ?
  @     position->north.quality : position->east.quality);
  @*/
void keel_position_step(keel_position_t *position, const keel_position_sample_t *sample);

KEEL_C_END

#endif
