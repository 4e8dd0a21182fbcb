/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/axis.h
 * @brief The contracts of axis.h, as the provers read them.
 *
 * Single precision: far from 0, a position moves in steps of its last place, 2^-11 m at half of
 * KEEL_AXIS_POSITION_LIMIT. No division and no library call in a step. Sources must be compiled
 * without contraction of products and sums, as all builds of Keel do.
 */
#ifndef KEEL_INTERNAL_FLIGHT_AXIS_H
#define KEEL_INTERNAL_FLIGHT_AXIS_H

#include "keel/c_declarations.h"
#include "keel/flight/axis.h"

KEEL_C_BEGIN

/*@ predicate axis_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ predicate axis_rate(keel_axis_config_t c) =
  @     axis_number(c.rate_hz, KEEL_AXIS_RATE_MIN_HZ, KEEL_AXIS_RATE_MAX_HZ);
  @
  @ predicate axis_gains(keel_axis_config_t c) =
  @     axis_number(c.position_gain, 0, KEEL_AXIS_PART_LIMIT) &&
  @     axis_number(c.velocity_gain, 0, KEEL_AXIS_VELOCITY_GAIN_LIMIT) &&
  @     axis_number(c.rate_gain, 0, KEEL_AXIS_PART_LIMIT) &&
  @     axis_number(c.bias_gain, 0, KEEL_AXIS_BIAS_GAIN_LIMIT);
  @
  @ predicate axis_limits(keel_axis_config_t c) =
  @     axis_number(c.bias_limit, 0, KEEL_AXIS_BIAS_LIMIT) &&
  @     axis_number(c.position_gate, 0, KEEL_AXIS_POSITION_LIMIT) &&
  @     axis_number(c.velocity_gate, 0, KEEL_AXIS_VELOCITY_LIMIT) &&
  @     0 < c.late_steps <= c.lost_steps && 0 < c.settle_fixes && 0 < c.jump_fixes;
  @
  @ // Of an axis, what a step needs.
  @ predicate axis_limited(keel_axis_t *axis) =
  @     axis_number(axis->config.bias_limit, 0, KEEL_AXIS_BIAS_LIMIT) &&
  @     \is_finite(axis->config.position_gate) && \is_finite(axis->config.velocity_gate);
  @
  @ // A fix that counts.
  @ predicate axis_counts(keel_axis_sample_t *s) = s->has_fix && s->is_usable &&
  @     axis_number(s->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
  @     (!s->has_velocity ||
  @         axis_number(s->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT));
  @
  @ predicate axis_told(keel_axis_t *axis, integer flag) = (axis->flags & flag) != 0;
  @*/

/*@ requires \valid(axis) && \valid_read(config) && \separated(axis, config);
  @ assigns *axis;
  @ ensures AXI_001_rate: !axis_rate(*config) ==> \result == KEEL_ERR_RATE;
  @ ensures AXI_001_gains: axis_rate(*config) && !axis_gains(*config) ==> \result == KEEL_ERR_GAIN;
  @ ensures AXI_001_limits: axis_rate(*config) && axis_gains(*config) && !axis_limits(*config) ==>
  @     \result == KEEL_ERR_LIMITS;
  @ ensures AXI_001_kept: \result != KEEL_OK ==> *axis == \old(*axis);
  @ ensures AXI_002_taken: axis_rate(*config) && axis_gains(*config) && axis_limits(*config) ==>
  @     \result == KEEL_OK && axis->config == *config && axis_limited(axis);
  @ ensures AXI_003_none: \result == KEEL_OK ==> axis->quality == KEEL_AXIS_NONE;
  @*/
keel_status_t keel_axis_init(keel_axis_t *axis, const keel_axis_config_t *config);

/*@ requires \valid(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->jump, axis->age, axis->agreed,
  @     axis->jumped, axis->flags, axis->quality;
  @ ensures AXI_003_zero: axis->position == 0 && axis->velocity == 0 && axis->bias == 0 &&
  @     axis->jump == 0;
  @ ensures AXI_003_age: axis->age == axis->config.lost_steps;
  @ ensures AXI_003_forgotten: axis->agreed == 0 && axis->jumped == 0 && axis->flags == 0 &&
  @     axis->quality == KEEL_AXIS_NONE;
  @*/
void keel_axis_restart(keel_axis_t *axis);

/*@ requires \valid(axis) && \valid_read(sample) && \separated(axis, sample);
  @ requires axis_limits: axis_limited(axis);
  @ assigns axis->position, axis->velocity, axis->bias, axis->jump, axis->age, axis->agreed,
  @     axis->jumped, axis->flags, axis->quality;
  @ ensures AXI_004_bias: !sample->has_fix && \is_finite(\old(axis->bias)) ==>
  @     axis->bias == \old(axis->bias);
  @ ensures AXI_004_velocity: !sample->has_fix && axis_told(axis, KEEL_AXIS_BLIND) &&
  @     axis_number(\old(axis->velocity), -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT) &&
  @     \is_finite(axis->step) ==> axis->velocity == \old(axis->velocity);
  @ ensures AXI_005_blind: axis_told(axis, KEEL_AXIS_BLIND) <==> !(sample->has_acceleration &&
  @     axis_number(sample->acceleration, -KEEL_AXIS_ACCELERATION_LIMIT,
  @         KEEL_AXIS_ACCELERATION_LIMIT));
  @ ensures AXI_006_position:
  @     axis_number(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT);
  @ ensures AXI_006_velocity:
  @     axis_number(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT);
  @ ensures AXI_006_bias:
  @     axis_number(\old(axis->bias), -axis->config.bias_limit, axis->config.bias_limit) ==>
  @     axis_number(axis->bias, -axis->config.bias_limit, axis->config.bias_limit);
  @ ensures AXI_007_unusable: axis_told(axis, KEEL_AXIS_UNUSABLE) <==>
  @     sample->has_fix && !axis_counts(sample);
  @ ensures AXI_008_counts: axis_counts(sample) <==>
  @     (axis_told(axis, KEEL_AXIS_FIXED) || axis_told(axis, KEEL_AXIS_JUMPED));
  @ ensures AXI_008_either: !(axis_told(axis, KEEL_AXIS_FIXED) &&
  @     axis_told(axis, KEEL_AXIS_JUMPED));
  @ ensures AXI_009_set: axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     axis_told(axis, KEEL_AXIS_FIXED) && axis->position == sample->position &&
  @     (sample->has_velocity ==> axis->velocity == sample->velocity) &&
  @     (!sample->has_velocity ==> axis->velocity == 0);
  @ ensures AXI_009_lost: axis_counts(sample) &&
  @     \old(axis->age) + 1 >= axis->config.lost_steps ==> axis_told(axis, KEEL_AXIS_BEGUN);
  @ ensures AXI_009_only: axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     \old(axis->age) + 1 >= axis->config.lost_steps || axis->config.jump_fixes <= 1 ||
  @     (axis_told(axis, KEEL_AXIS_AGAIN) &&
  @         \old(axis->jumped) + 1 >= axis->config.jump_fixes);
  @ ensures AXI_009_jumped: axis->jumped == ((axis->flags & KEEL_AXIS_FIXED) != 0 ? 0 :
  @     (axis->flags & KEEL_AXIS_JUMPED) == 0 ? \old(axis->jumped) :
  @     (axis->flags & KEEL_AXIS_AGAIN) != 0 ? \old(axis->jumped) + 1 : 1);
  @ ensures AXI_013_again: axis_told(axis, KEEL_AXIS_AGAIN) ==> \old(axis->jumped) > 0 &&
  @     (axis_told(axis, KEEL_AXIS_JUMPED) || axis_told(axis, KEEL_AXIS_BEGUN));
  @ ensures AXI_013_jump: axis_told(axis, KEEL_AXIS_JUMPED) ==> axis->jump == sample->position;
  @ ensures AXI_013_kept: !axis_told(axis, KEEL_AXIS_JUMPED) && \is_finite(\old(axis->jump)) ==>
  @     axis->jump == \old(axis->jump);
  @ ensures AXI_009_believed: axis_told(axis, KEEL_AXIS_JUMPED) ==>
  @     axis->jumped < axis->config.jump_fixes;
  @ ensures AXI_010_age: axis->age == ((axis->flags & KEEL_AXIS_FIXED) != 0 ? 0 :
  @     \old(axis->age) < axis->config.lost_steps ? \old(axis->age) + 1 :
  @     axis->config.lost_steps);
  @ ensures AXI_011_disagreed: axis_told(axis, KEEL_AXIS_JUMPED) ||
  @     axis_told(axis, KEEL_AXIS_UNUSABLE) || axis_told(axis, KEEL_AXIS_BEGUN) ==>
  @     axis->agreed == 0;
  @ ensures AXI_011_agreed: axis_told(axis, KEEL_AXIS_FIXED) &&
  @     !axis_told(axis, KEEL_AXIS_BEGUN) ==> axis->agreed ==
  @     (\old(axis->agreed) < axis->config.settle_fixes ? \old(axis->agreed) + 1 :
  @     axis->config.settle_fixes);
  @ ensures AXI_011_kept: !sample->has_fix ==> axis->agreed == \old(axis->agreed);
  @ ensures AXI_012_none: axis->quality == KEEL_AXIS_NONE <==>
  @     axis->age >= axis->config.lost_steps;
  @ ensures AXI_012_good: axis->quality == KEEL_AXIS_GOOD <==>
  @     axis->age < axis->config.late_steps && axis->age < axis->config.lost_steps &&
  @     axis->agreed >= axis->config.settle_fixes && !axis_told(axis, KEEL_AXIS_BLIND);
  @ ensures AXI_012_one: axis->quality <= KEEL_AXIS_GOOD;
  @*/
void keel_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample);

KEEL_C_END

#endif
