/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/cascade.h
 * @brief The contracts of cascade.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_FLIGHT_CASCADE_H
#define KEEL_INTERNAL_FLIGHT_CASCADE_H

#include "keel/c_declarations.h"
#include "keel/flight/cascade.h"
#include "keel/internal/flight/attitude.h"
#include "keel/internal/flight/mixer.h"
#include "keel/internal/flight/pid.h"

KEEL_C_BEGIN

/*@ predicate cascade_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ logic real cascade_reach_max(integer axis) =
  @     axis <= KEEL_CASCADE_YAW_RATE ? KEEL_CASCADE_RATE_MAX :
  @     axis <= KEEL_CASCADE_PITCH ? KEEL_CASCADE_TILT_MAX :
  @     axis <= KEEL_CASCADE_CLIMB ? KEEL_CASCADE_SPEED_MAX : KEEL_CASCADE_DISTANCE_MAX;
  @
  @ predicate cascade_axis_valid(keel_cascade_axis_t *a) =
  @     pid_valid(a->pid) && cascade_number(a->reach, 0, KEEL_CASCADE_DISTANCE_MAX);
  @
  @ // An axis asks for no more than this, in either direction.
  @ predicate cascade_asks_within(keel_cascade_axis_t *a, real most) =
  @     -most <= a->pid.config.output_min && a->pid.config.output_max <= most;
  @
  @ predicate cascade_fence_valid(keel_cascade_fence_t f) =
  @     cascade_number(f.gain, 0, KEEL_CASCADE_ACCELERATION_MAX * KEEL_CASCADE_REACTION_MAX_S) &&
  @     cascade_number(f.half_gain, 0,
  @         KEEL_CASCADE_ACCELERATION_MAX * KEEL_CASCADE_REACTION_MAX_S) &&
  @     cascade_number(f.reaction_s, 0, KEEL_CASCADE_REACTION_MAX_S) &&
  @     cascade_number(f.twice_braking, 0, 2 * KEEL_CASCADE_ACCELERATION_MAX);
  @
  @ // Init establishes this, and every step keeps it.
  @ predicate cascade_valid(keel_cascade_t *c) =
  @     (\forall integer i; 0 <= i < KEEL_CASCADE_AXES ==> cascade_axis_valid(&c->axis[i])) &&
  @     (\forall integer i; 0 <= i <= KEEL_CASCADE_YAW_RATE ==>
  @         cascade_asks_within(&c->axis[i], 1)) &&
  @     (\forall integer i; KEEL_CASCADE_ROLL <= i <= KEEL_CASCADE_PITCH ==>
  @         cascade_asks_within(&c->axis[i], c->axis[i - 3].reach)) &&
  @     (\forall integer i; KEEL_CASCADE_NORTH_SPEED <= i <= KEEL_CASCADE_EAST_SPEED ==>
  @         cascade_asks_within(&c->axis[i], KEEL_CASCADE_GRAVITY)) &&
  @     cascade_asks_within(&c->axis[KEEL_CASCADE_CLIMB], 1) &&
  @     (\forall integer i; KEEL_CASCADE_NORTH <= i <= KEEL_CASCADE_HEIGHT ==>
  @         cascade_asks_within(&c->axis[i], c->axis[i - 3].reach)) &&
  @     cascade_fence_valid(c->fence) && cascade_number(c->hover, 0, 1) &&
  @     mixer_command(c->command);
  @
  @ // Whether a set-point towards a side is no longer admitted, `way` being the distance to it and
  @ // `speed` that towards it: the formula above, rounded after each operation.
  @ logic float cascade_fastest(keel_cascade_fence_t f, float speed) = (float)(speed + f.gain);
  @
  @ logic float cascade_left(keel_cascade_fence_t f, float way, float speed) = (float)(
  @     way - (float)(f.reaction_s * (float)(speed + f.half_gain)));
  @
  @ logic float cascade_square(float speed) = (float)(speed > 0 ? (float)(speed * speed) : 0);
  @
  @ predicate cascade_near(keel_cascade_fence_t f, float way, float speed) =
  @     !(cascade_square(cascade_fastest(f, speed)) <=
  @         (float)(f.twice_braking * cascade_left(f, way, speed)));
  @
  @ // Where a side is near, an axis of the velocity stage says so and is not asked to go there.
  @ predicate cascade_fenced(keel_cascade_t *c, integer axis, float position, float speed) =
  @     (cascade_near(c->fence, (float)(c->axis[axis + 3].reach - position), speed) ==>
  @         c->axis[axis].limit.at_max &&
  @         (c->axis[axis].held || c->axis[axis].pid.setpoint <= 0)) &&
  @     (cascade_near(c->fence, (float)(c->axis[axis + 3].reach + position), (float)-speed) ==>
  @         c->axis[axis].limit.at_min &&
  @         (c->axis[axis].held || c->axis[axis].pid.setpoint >= 0));
  @
  @ // The axes that a mode flies.
  @ logic integer cascade_axes(integer mode) =
  @     mode == 0 ? 0x07 : mode == 1 ? 0x9F : mode == 2 ? 0x1F : mode == 3 ? 0x49F :
  @     mode == 4 || mode == 5 ? 0x7FF : 0;
  @*/

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures CAS_001_axis: axis >= KEEL_CASCADE_AXES ==> \result == KEEL_ERR_INPUT;
  @ ensures CAS_001_reach: \result == KEEL_OK ==> axis < KEEL_CASCADE_AXES &&
  @     cascade_number(config->reach[axis], 0, cascade_reach_max(axis));
  @ ensures CAS_001_limits: \result == KEEL_OK ==> pid_limits(config->pid[axis]);
  @*/
keel_status_t keel_cascade_check(const keel_cascade_config_t *config, uint32_t axis);

/*@ requires \valid(cascade) && \valid_read(config) && \separated(cascade, config);
  @ assigns *cascade;
  @ ensures CAS_002_valid: \result == KEEL_OK ==> cascade_valid(cascade);
  @ ensures CAS_002_still: \result == KEEL_OK ==> cascade->axes == 0 &&
  @     \forall integer i; 0 <= i < KEEL_CASCADE_AXES ==> !cascade->axis[i].running;
  @ ensures CAS_002_kept: \result != KEEL_OK ==> *cascade == \old(*cascade);
  @*/
keel_status_t keel_cascade_init(keel_cascade_t *cascade, const keel_cascade_config_t *config);

/*@ requires \valid(cascade);
  @ assigns cascade->axes, cascade->axis[0 .. KEEL_CASCADE_AXES - 1].running, cascade->command;
  @ ensures CAS_003_axes: cascade->axes == cascade_axes(mode);
  @ ensures CAS_003_stopped: \forall integer i; 0 <= i < KEEL_CASCADE_AXES ==>
  @     (cascade->axis[i].running ==> \old(cascade->axis[i].running));
  @ ensures CAS_003_none: cascade->axes == 0 ==> mixer_command(cascade->command) &&
  @     cascade->command.roll == 0 && cascade->command.pitch == 0 && cascade->command.yaw == 0 &&
  @     cascade->command.thrust == 0;
  @*/
void keel_cascade_enter(keel_cascade_t *cascade, uint8_t mode);

/*@ requires \valid(axis) && \valid_read(input) && \separated(axis, input);
  @ requires axis_valid: cascade_axis_valid(axis);
  @ assigns axis->pid.filter.s1, axis->pid.filter.s2, axis->pid.filter.output, axis->pid.integral,
  @     axis->pid.setpoint, axis->pid.error, axis->pid.derivative, axis->pid.output,
  @     axis->pid.saturation, axis->pid.started, axis->limit, axis->running, axis->held;
  @ ensures CAS_004_valid: cascade_axis_valid(axis);
  @ ensures CAS_004_output: pid_within(axis->pid.output, axis->pid.config.output_min,
  @     axis->pid.config.output_max);
  @ ensures CAS_005_stops: !input->valid ==> !axis->running;
  @ ensures CAS_005_held: axis->held && \old(axis->running) ==>
  @     axis->pid.output == \old(axis->pid.output) &&
  @     axis->pid.integral == \old(axis->pid.integral);
  @ ensures CAS_005_taken: !axis->held ==> axis->running &&
  @     -axis->reach <= axis->pid.setpoint <= axis->reach;
  @ ensures CAS_006_rises: \old(axis->running) && input->below.at_max ==>
  @     axis->pid.integral <= \old(axis->pid.integral);
  @ ensures CAS_006_falls: \old(axis->running) && input->below.at_min ==>
  @     axis->pid.integral >= \old(axis->pid.integral);
  @ ensures CAS_006_told: (input->below.at_max ==> axis->limit.at_max) &&
  @     (input->below.at_min ==> axis->limit.at_min);
  @ ensures CAS_007_entered: !\old(axis->running) && axis->running ==> input->valid;
  @*/
void keel_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input);

/*@ requires \valid(cascade) && cascade_valid(cascade);
  @ assigns cascade->axis[KEEL_CASCADE_ROLL_RATE .. KEEL_CASCADE_YAW_RATE], cascade->gave_way,
  @     cascade->command;
  @ ensures CAS_004_rate: cascade_valid(cascade);
  @ ensures CAS_008_command: mixer_command(cascade->command);
  @*/
void keel_cascade_rate_step(keel_cascade_t *cascade, keel_cascade_rates_t asked,
                            keel_attitude_vector_t rate, uint32_t gave_way);

/*@ requires \valid(cascade) && cascade_valid(cascade);
  @ assigns cascade->axis[KEEL_CASCADE_ROLL .. KEEL_CASCADE_PITCH], cascade->rates;
  @ ensures CAS_004_angle: cascade_valid(cascade);
  @ ensures CAS_009_rates:
  @     cascade_number(cascade->rates.roll, -cascade->axis[KEEL_CASCADE_ROLL_RATE].reach,
  @         cascade->axis[KEEL_CASCADE_ROLL_RATE].reach) &&
  @     cascade_number(cascade->rates.pitch, -cascade->axis[KEEL_CASCADE_PITCH_RATE].reach,
  @         cascade->axis[KEEL_CASCADE_PITCH_RATE].reach);
  @*/
void keel_cascade_angle_step(keel_cascade_t *cascade, keel_cascade_tilt_t asked,
                             keel_attitude_vector_t down, bool valid);

/*@ requires \valid(cascade) && \valid_read(estimate) && \separated(cascade, estimate);
  @ requires cascade_valid(cascade);
  @ assigns cascade->axis[KEEL_CASCADE_NORTH_SPEED .. KEEL_CASCADE_CLIMB], cascade->tilt,
  @     cascade->thrust;
  @ ensures CAS_004_velocity: cascade_valid(cascade);
  @ ensures CAS_010_tilt:
  @     cascade_number(cascade->tilt.roll, -cascade->axis[KEEL_CASCADE_ROLL].reach,
  @         cascade->axis[KEEL_CASCADE_ROLL].reach) &&
  @     cascade_number(cascade->tilt.pitch, -cascade->axis[KEEL_CASCADE_PITCH].reach,
  @         cascade->axis[KEEL_CASCADE_PITCH].reach);
  @ ensures CAS_010_thrust: cascade_number(cascade->thrust, 0, 1);
  @ ensures CAS_011_fence:
  @     cascade_fenced(cascade, KEEL_CASCADE_NORTH_SPEED, estimate->position.north,
  @         estimate->velocity.north) &&
  @     cascade_fenced(cascade, KEEL_CASCADE_EAST_SPEED, estimate->position.east,
  @         estimate->velocity.east) &&
  @     cascade_fenced(cascade, KEEL_CASCADE_CLIMB, estimate->position.up, estimate->velocity.up);
  @*/
void keel_cascade_velocity_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate);

/*@ requires \valid(cascade) && \valid_read(estimate) && \separated(cascade, estimate);
  @ requires cascade_valid(cascade);
  @ assigns cascade->axis[KEEL_CASCADE_NORTH .. KEEL_CASCADE_HEIGHT], cascade->velocity;
  @ ensures CAS_004_position: cascade_valid(cascade);
  @ ensures CAS_013_speeds:
  @     cascade_number(cascade->velocity.north, -cascade->axis[KEEL_CASCADE_NORTH_SPEED].reach,
  @         cascade->axis[KEEL_CASCADE_NORTH_SPEED].reach) &&
  @     cascade_number(cascade->velocity.east, -cascade->axis[KEEL_CASCADE_EAST_SPEED].reach,
  @         cascade->axis[KEEL_CASCADE_EAST_SPEED].reach) &&
  @     cascade_number(cascade->velocity.up, -cascade->axis[KEEL_CASCADE_CLIMB].reach,
  @         cascade->axis[KEEL_CASCADE_CLIMB].reach);
  @*/
void keel_cascade_position_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                const keel_cascade_estimate_t *estimate);

KEEL_C_END

#endif
