/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/virtual_imu.h
 * @brief The contracts of virtual_imu.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_VIRTUAL_IMU_H
#define KEEL_INTERNAL_MIDDLEWARE_VIRTUAL_IMU_H

#include "keel/c_declarations.h"
#include "keel/internal/middleware/voter.h"
#include "keel/middleware/virtual_imu.h"

KEEL_C_BEGIN

/*@ // A unit's verdict on a channel: its bit.
  @ predicate virtual_imu_bit(integer verdict, integer channel) = ((verdict >> channel) & 1) == 1;
  @
  @ // Whether a sensor contributed to a vote; before the first vote none has.
  @ predicate voter_contributed(keel_vote_t *vote, integer sensor) =
  @     vote->contributing > 0 && vote->reason[sensor] == KEEL_VOTER_USED;
  @
  @ // The verdicts say what the channels say.
  @ predicate virtual_imu_noted(keel_virtual_imu_t *imu) =
  @     \forall integer k, i; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS &&
  @         0 <= i < imu->channel[k].config.sensors ==>
  @         (virtual_imu_bit(imu->used[i], k) <==>
  @             voter_contributed(&imu->channel[k].vote, i)) &&
  @         (virtual_imu_bit(imu->latched[i], k) <==> imu->channel[k].sensor[i].latched);
  @
  @ // This holds of a virtual unit between any two calls.
  @ predicate virtual_imu_valid(keel_virtual_imu_t *imu) =
  @     virtual_imu_noted(imu) &&
  @     \forall integer k; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS ==>
  @         voter_valid(&imu->channel[k]) &&
  @         imu->channel[k].config.sensors == imu->channel[0].config.sensors;
  @
  @ // Whether a configuration is accepted.
  @ predicate virtual_imu_config_valid(keel_virtual_imu_config_t c) =
  @     voter_config_valid(c.accelerometer) && voter_config_valid(c.gyroscope) &&
  @     c.accelerometer.sensors == c.gyroscope.sensors;
  @*/

/*@ requires \valid(imu) && \valid_read(config) && \separated(imu, config);
  @ assigns *imu;
  @ ensures IMU_001_accepted: \result == KEEL_OK <==> virtual_imu_config_valid(*config);
  @ ensures IMU_001_differ: voter_config_valid(config->accelerometer) &&
  @     voter_config_valid(config->gyroscope) &&
  @     config->accelerometer.sensors != config->gyroscope.sensors ==>
  @         \result == KEEL_ERR_SENSORS;
  @ ensures IMU_001_kept: \result != KEEL_OK ==> *imu == \old(*imu);
  @ ensures IMU_001_ready: \result == KEEL_OK ==> virtual_imu_valid(imu);
  @ ensures IMU_001_accelerometer: \result == KEEL_OK ==> \forall integer k;
  @     0 <= k < KEEL_VIRTUAL_IMU_ACCELEROMETER ==>
  @         imu->channel[k].config == config->accelerometer &&
  @         imu->channel[k].vote.output == config->accelerometer.initial;
  @ ensures IMU_001_gyroscope: \result == KEEL_OK ==> \forall integer k;
  @     KEEL_VIRTUAL_IMU_ACCELEROMETER <= k < KEEL_VIRTUAL_IMU_CHANNELS ==>
  @         imu->channel[k].config == config->gyroscope &&
  @         imu->channel[k].vote.output == config->gyroscope.initial;
  @ ensures IMU_001_fresh: \result == KEEL_OK ==> \forall integer i;
  @     0 <= i < KEEL_VOTER_SENSORS ==> imu->used[i] == 0 && imu->latched[i] == 0;
  @*/
keel_status_t keel_virtual_imu_init(keel_virtual_imu_t *imu,
                                    const keel_virtual_imu_config_t *config);

/*@ requires \valid(imu) && virtual_imu_valid(imu);
  @ requires \valid_read(sample + (0 .. imu->channel[0].config.sensors - 1));
  @ requires \separated(imu, sample + (0 .. imu->channel[0].config.sensors - 1));
  @ assigns *imu;
  @ ensures IMU_002_valid: virtual_imu_valid(imu);
  @ ensures IMU_002_config: \forall integer k; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS ==>
  @     imu->channel[k].config == \old(imu->channel[k].config);
  @ ensures IMU_005_thresholds: \forall integer k; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS ==>
  @     imu->channel[k].config.agree <= imu->channel[k].agree &&
  @     (imu->channel[k].config.slope == 0 ==>
  @         imu->channel[k].agree == imu->channel[k].config.agree);
  @ ensures IMU_006_back: \forall integer k, i; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS &&
  @     0 <= i < imu->channel[k].config.sensors &&
  @     \old(imu->channel[k].sensor[i].latched) && !imu->channel[k].sensor[i].latched ==>
  @         0 < imu->channel[k].config.readmit_count <=
  @             \old(imu->channel[k].sensor[i].probation) + 1 &&
  @         sample[i].present && imu->channel[k].config.lowest <= sample[i].value[k] <=
  @             imu->channel[k].config.highest;
  @ ensures IMU_003_used: \forall integer k, i; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS &&
  @     0 <= i < imu->channel[k].config.sensors ==>
  @         (virtual_imu_bit(imu->used[i], k) <==>
  @             imu->channel[k].vote.reason[i] == KEEL_VOTER_USED);
  @ ensures IMU_003_latched: \forall integer k, i; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS &&
  @     0 <= i < imu->channel[k].config.sensors ==>
  @         (virtual_imu_bit(imu->latched[i], k) <==> imu->channel[k].sensor[i].latched);
  @*/
void keel_virtual_imu_step(keel_virtual_imu_t *imu, const keel_virtual_imu_sample_t sample[],
                           uint32_t elapsed_us);

/*@ requires \valid(imu) && virtual_imu_valid(imu);
  @ assigns *imu;
  @ ensures IMU_004_valid: virtual_imu_valid(imu);
  @ ensures IMU_004_unknown: unit >= imu->channel[0].config.sensors <==>
  @     \result == KEEL_ERR_SENSORS;
  @ ensures IMU_004_accepted: \result == KEEL_OK <==>
  @     unit < imu->channel[0].config.sensors && (\exists integer k;
  @         0 <= k < KEEL_VIRTUAL_IMU_CHANNELS && \old(imu->channel[k].sensor[unit].latched));
  @ ensures IMU_004_readmitted: \result == KEEL_OK ==> \forall integer k;
  @     0 <= k < KEEL_VIRTUAL_IMU_CHANNELS ==> !imu->channel[k].sensor[unit].latched;
  @ ensures IMU_004_noted: \result == KEEL_OK ==> imu->latched[unit] == 0;
  @ ensures IMU_004_others: \forall integer k, i; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS &&
  @     0 <= i < KEEL_VOTER_SENSORS && i != unit ==>
  @         imu->channel[k].sensor[i] == \old(imu->channel[k].sensor[i]) &&
  @         imu->latched[i] == \old(imu->latched[i]);
  @ ensures IMU_004_votes: \forall integer k; 0 <= k < KEEL_VIRTUAL_IMU_CHANNELS ==>
  @     imu->channel[k].vote == \old(imu->channel[k].vote);
  @ ensures IMU_004_used: \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==>
  @     imu->used[i] == \old(imu->used[i]);
  @ ensures IMU_004_kept: \result != KEEL_OK ==> *imu == \old(*imu);
  @*/
keel_status_t keel_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit);

KEEL_C_END

#endif
