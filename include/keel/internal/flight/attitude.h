/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/flight/attitude.h
 * @brief The contracts of attitude.h, and the functions that no user calls.
 */
#ifndef KEEL_INTERNAL_FLIGHT_ATTITUDE_H
#define KEEL_INTERNAL_FLIGHT_ATTITUDE_H

#include "keel/c_declarations.h"
#include "keel/flight/attitude.h"
#include "keel/internal/middleware/virtual_imu.h"

KEEL_C_BEGIN

/*@ predicate attitude_number(float value, real least, real most) =
  @     \is_finite(value) && least <= value <= most;
  @
  @ predicate attitude_rate(keel_attitude_config_t c) = attitude_number(
  @     c.rate_hz, KEEL_ATTITUDE_RATE_MIN_HZ, KEEL_ATTITUDE_RATE_MAX_HZ);
  @
  @ predicate attitude_gains(keel_attitude_config_t c) =
  @     attitude_number(c.tilt_gain, 0, KEEL_ATTITUDE_GAIN_LIMIT) &&
  @     attitude_number(c.heading_gain, 0, KEEL_ATTITUDE_GAIN_LIMIT) &&
  @     attitude_number(c.align_gain, 0, KEEL_ATTITUDE_GAIN_LIMIT) &&
  @     attitude_number(c.bias_gain, 0, KEEL_ATTITUDE_GAIN_LIMIT) &&
  @     attitude_number(c.force_gain, 0, KEEL_ATTITUDE_GAIN_LIMIT) &&
  @     attitude_number(c.field_share, 0, 1);
  @
  @ predicate attitude_limits(keel_attitude_config_t c) =
  @     attitude_number(c.bias_limit, 0, KEEL_ATTITUDE_BIAS_LIMIT) &&
  @     attitude_number(c.clip_rate, 0, KEEL_ATTITUDE_RATE_LIMIT) &&
  @     attitude_number(c.quiet_rate, 0, c.clip_rate) &&
  @     attitude_number(c.still_rate, 0, KEEL_ATTITUDE_STILL_RATE_LIMIT) &&
  @     attitude_number(c.still_acceleration, 0, KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT) &&
  @     attitude_number(c.tolerance, 0, 1);
  @
  @ predicate attitude_is_zero(keel_attitude_vector_t v) = v.x == 0 && v.y == 0 && v.z == 0;
  @
  @ predicate attitude_within(keel_attitude_vector_t v, real most) =
  @     attitude_number(v.x, -most, most) && attitude_number(v.y, -most, most) &&
  @     attitude_number(v.z, -most, most);
  @
  @ // A component of a unit quaternion, by |q|^2 as computed: 1 + 2^-10 at most.
  @ predicate attitude_components(keel_attitude_quaternion_t q) =
  @     attitude_number(q.w, -0x1.004p+0, 0x1.004p+0) &&
  @     attitude_number(q.x, -0x1.004p+0, 0x1.004p+0) &&
  @     attitude_number(q.y, -0x1.004p+0, 0x1.004p+0) &&
  @     attitude_number(q.z, -0x1.004p+0, 0x1.004p+0);
  @
  @ predicate attitude_steps(keel_attitude_config_t c) =
  @     c.still_steps > 0 && c.settle_steps > 0 && c.lost_steps > 0 && c.field_steps > 0;
  @*/

/*@ requires \valid(attitude) && \valid_read(config) && \separated(attitude, config);
  @ assigns *attitude;
  @ ensures ATT_001_rate: !attitude_rate(*config) ==> \result == KEEL_ERR_RATE;
  @ ensures ATT_001_gains: attitude_rate(*config) && !attitude_gains(*config) ==>
  @     \result == KEEL_ERR_GAIN;
  @ ensures ATT_001_limits: attitude_rate(*config) && attitude_gains(*config) &&
  @     !(attitude_limits(*config) && attitude_steps(*config)) ==> \result == KEEL_ERR_LIMITS;
  @ ensures ATT_001_kept: \result != KEEL_OK ==> *attitude == \old(*attitude);
  @ ensures ATT_002_taken: \result == KEEL_OK ==> attitude->config == *config;
  @*/
keel_status_t keel_attitude_init(keel_attitude_t *attitude, const keel_attitude_config_t *config);

/*@ requires \valid(attitude);
  @ assigns attitude->quaternion, attitude->bias, attitude->rate, attitude->gyroscope,
  @     attitude->first_rate, attitude->first_force, attitude->sum, attitude->down,
  @     attitude->field, attitude->heading_error, attitude->still, attitude->settled,
  @     attitude->heading_settled, attitude->lost, attitude->field_age, attitude->flags,
  @     attitude->heading_valid, attitude->phase;
  @ ensures ATT_003_level: attitude->quaternion.w == 1 && attitude->quaternion.x == 0 &&
  @     attitude->quaternion.y == 0 && attitude->quaternion.z == 0;
  @ ensures ATT_003_unbiased: attitude->bias.x == 0 && attitude->bias.y == 0 &&
  @     attitude->bias.z == 0;
  @ ensures ATT_003_forgets: attitude_is_zero(attitude->down) && attitude_is_zero(attitude->field);
  @ ensures ATT_003_still: attitude->phase == KEEL_ATTITUDE_STILL && !attitude->heading_valid;
  @*/
void keel_attitude_restart(keel_attitude_t *attitude);

/*@ requires \valid(sample) && \valid_read(imu) && \separated(sample, imu);
  @ assigns sample->gyroscope, sample->accelerometer, sample->has_gyroscope,
  @     sample->has_accelerometer;
  @ ensures ATT_004_there: sample->has_gyroscope <==>
  @     imu->channel[KEEL_VIRTUAL_IMU_ACCELEROMETER].vote.contributing > 0 &&
  @     imu->channel[KEEL_VIRTUAL_IMU_ACCELEROMETER + 1].vote.contributing > 0 &&
  @     imu->channel[KEEL_VIRTUAL_IMU_ACCELEROMETER + 2].vote.contributing > 0;
  @*/
void keel_attitude_take(keel_attitude_sample_t *sample, const keel_virtual_imu_t *imu);

/*@ requires \valid(attitude) && \valid_read(sample) && \separated(attitude, sample);
  @ requires attitude_number(attitude->config.bias_limit, 0, KEEL_ATTITUDE_BIAS_LIMIT);
  @ requires attitude_number(attitude->config.tolerance, 0, 1);
  @ requires \is_finite(attitude->config.clip_rate) &&
  @     \is_finite(attitude->config.still_rate) &&
  @     \is_finite(attitude->config.still_acceleration);
  @ assigns attitude->quaternion, attitude->bias, attitude->rate, attitude->gyroscope,
  @     attitude->first_rate, attitude->first_force, attitude->sum, attitude->down,
  @     attitude->field, attitude->heading_error, attitude->still, attitude->settled,
  @     attitude->heading_settled, attitude->lost, attitude->field_age, attitude->flags,
  @     attitude->heading_valid, attitude->phase;
  @ ensures ATT_005_lost: !sample->has_gyroscope ==> (attitude->flags & KEEL_ATTITUDE_LOST) != 0;
  @ ensures ATT_006_down: (attitude->flags & KEEL_ATTITUDE_DOWN) != 0 ==>
  @     sample->has_accelerometer &&
  @     attitude_within(sample->accelerometer, KEEL_ATTITUDE_FORCE_LIMIT);
  @ ensures ATT_007_compensated: (attitude->flags & KEEL_ATTITUDE_COMPENSATED) != 0 ==>
  @     sample->has_acceleration &&
  @     attitude_within(sample->acceleration, KEEL_ATTITUDE_FORCE_LIMIT);
  @ ensures ATT_008_field: (attitude->flags & KEEL_ATTITUDE_FIELD) != 0 ==>
  @     sample->has_magnetometer &&
  @     attitude_within(sample->magnetometer, KEEL_ATTITUDE_FIELD_REACH) &&
  @     attitude->field_age == 0;
  @ ensures ATT_009_rate: attitude_within(\old(attitude->bias), KEEL_ATTITUDE_BIAS_LIMIT) &&
  @     attitude_within(attitude->gyroscope, KEEL_ATTITUDE_RATE_LIMIT) ==>
  @     attitude->rate.x == (float)(attitude->gyroscope.x - \old(attitude->bias.x)) &&
  @     attitude->rate.y == (float)(attitude->gyroscope.y - \old(attitude->bias.y)) &&
  @     attitude->rate.z == (float)(attitude->gyroscope.z - \old(attitude->bias.z));
  @ ensures ATT_011_components: attitude_components(attitude->quaternion);
  @ ensures ATT_012_limit: attitude_within(\old(attitude->bias), attitude->config.bias_limit) ==>
  @     attitude_within(attitude->bias, attitude->config.bias_limit);
  @ ensures ATT_012_rests: (attitude->flags & KEEL_ATTITUDE_DOWN) == 0 &&
  @     \old(attitude->phase) != KEEL_ATTITUDE_STILL &&
  @     attitude_within(\old(attitude->bias), attitude->config.bias_limit) ==>
  @     attitude->bias.x == \old(attitude->bias.x) && attitude->bias.y == \old(attitude->bias.y) &&
  @     attitude->bias.z == \old(attitude->bias.z);
  @ ensures ATT_013_mean: \old(attitude->phase) == KEEL_ATTITUDE_STILL &&
  @     attitude->phase != KEEL_ATTITUDE_STILL ==>
  @     attitude->phase == KEEL_ATTITUDE_ALIGNING && attitude->still == 0;
  @ ensures ATT_014_begins: attitude->phase == KEEL_ATTITUDE_RUNNING &&
  @     \old(attitude->phase) != KEEL_ATTITUDE_RUNNING ==>
  @     \old(attitude->phase) == KEEL_ATTITUDE_ALIGNING && attitude->lost == 0 &&
  @     attitude->settled == attitude->config.settle_steps;
  @ ensures ATT_014_ends: \old(attitude->phase) == KEEL_ATTITUDE_RUNNING &&
  @     attitude->phase != KEEL_ATTITUDE_RUNNING ==>
  @     attitude->phase == KEEL_ATTITUDE_ALIGNING && attitude->settled == 0 &&
  @     !attitude->heading_valid;
  @ ensures ATT_014_one: \old(attitude->phase) <= KEEL_ATTITUDE_RUNNING ==>
  @     attitude->phase <= KEEL_ATTITUDE_RUNNING;
  @ ensures ATT_015_begins: attitude->heading_valid && !\old(attitude->heading_valid) ==>
  @     attitude->phase == KEEL_ATTITUDE_RUNNING &&
  @     (attitude->flags & KEEL_ATTITUDE_FIELD) != 0 &&
  @     attitude->heading_settled == attitude->config.settle_steps;
  @ ensures ATT_016_told: (attitude->flags & KEEL_ATTITUDE_CORRUPTED) != 0 ==>
  @     attitude->quaternion.w == 1 && attitude->quaternion.x == 0 &&
  @     attitude->quaternion.y == 0 && attitude->quaternion.z == 0 &&
  @     attitude->phase != KEEL_ATTITUDE_RUNNING && attitude_is_zero(attitude->down) &&
  @     attitude_is_zero(attitude->field);
  @ ensures ATT_020_bounded: attitude_within(attitude->down, KEEL_ATTITUDE_DOWN_REACH) &&
  @     attitude_within(attitude->field, KEEL_ATTITUDE_FIELD_REACH);
  @*/
void keel_attitude_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample);

/**
 * Whether a quaternion is one that steps leave: |q|^2, as computed, lies between
 * KEEL_ATTITUDE_NORM_MIN and KEEL_ATTITUDE_NORM_MAX (requirement ATT-016). A step asks it of what
 * it leaves; so may whoever keeps a copy.
 *
 * @param q any bit pattern
 * @return false for what is no number, too
 */
/*@ assigns \nothing;
  @ ensures ATT_011_unit: \result ==> attitude_components(q);
  @ ensures ATT_016_unit: attitude_components(q) ==> (\result <==>
  @     attitude_number((float)((float)((float)(q.w * q.w) + (float)(q.x * q.x)) +
  @                             (float)((float)(q.y * q.y) + (float)(q.z * q.z))),
  @                     KEEL_ATTITUDE_NORM_MIN, KEEL_ATTITUDE_NORM_MAX));
  @*/
bool keel_attitude_is_unit(keel_attitude_quaternion_t q);

/*@ requires \valid_read(attitude);
  @ assigns \nothing;
  @ ensures ATT_019_down: attitude_components(attitude->quaternion) ==>
  @     \result.z == (float)(1 - (float)(
  @         (float)(attitude->quaternion.x * (2 * attitude->quaternion.x)) +
  @         (float)(attitude->quaternion.y * (2 * attitude->quaternion.y))));
  @*/
keel_attitude_vector_t keel_attitude_down(const keel_attitude_t *attitude);

KEEL_C_END

#endif
