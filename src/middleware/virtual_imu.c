/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/virtual_imu.h"

keel_status_t keel_virtual_imu_init(keel_virtual_imu_t *imu,
                                    const keel_virtual_imu_config_t *config)
{
    const keel_status_t accelerometer = keel_voter_check(&config->accelerometer);
    const keel_status_t gyroscope = keel_voter_check(&config->gyroscope);

    if (accelerometer != KEEL_OK) {
        return accelerometer;
    }
    if (gyroscope != KEEL_OK) {
        return gyroscope;
    }
    if (config->accelerometer.sensors != config->gyroscope.sensors) {
        return KEEL_ERR_SENSORS;
    }
    /*@ loop invariant 0 <= k <= KEEL_VIRTUAL_IMU_CHANNELS;
      @ loop assigns k, imu->channel[0 .. KEEL_VIRTUAL_IMU_CHANNELS - 1];
      @ loop variant KEEL_VIRTUAL_IMU_CHANNELS - k;
      @*/
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        /* Both are valid, so this refuses nothing. */
        (void)keel_voter_init(&imu->channel[k], (k < KEEL_VIRTUAL_IMU_ACCELEROMETER)
                                                    ? &config->accelerometer
                                                    : &config->gyroscope);
    }
    /*@ loop invariant 0 <= i <= KEEL_VOTER_SENSORS;
      @ loop assigns i, imu->used[0 .. KEEL_VOTER_SENSORS - 1],
      @     imu->latched[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant KEEL_VOTER_SENSORS - i;
      @*/
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        imu->used[i] = 0u;
        imu->latched[i] = 0u;
    }
    return KEEL_OK;
}

/* The bit of a channel among those of a unit. */
/*@ requires channel < KEEL_VIRTUAL_IMU_CHANNELS;
  @ assigns \nothing;
  @*/
static uint32_t channel_bit(uint32_t channel)
{
    static const uint8_t bits[KEEL_VIRTUAL_IMU_CHANNELS] = {0x01u, 0x02u, 0x04u,
                                                            0x08u, 0x10u, 0x20u};

    return bits[channel];
}

/* Notes the verdicts of a channel's last vote. Of a sensor that contributed there is none. */
/*@ requires \valid(imu) && channel < KEEL_VIRTUAL_IMU_CHANNELS;
  @ requires imu->channel[channel].config.sensors <= KEEL_VOTER_SENSORS;
  @ assigns imu->used[0 .. KEEL_VOTER_SENSORS - 1], imu->latched[0 .. KEEL_VOTER_SENSORS - 1];
  @*/
static void note_verdicts(keel_virtual_imu_t *imu, uint32_t channel)
{
    const keel_voter_t *const voter = &imu->channel[channel];
    const uint32_t bit = channel_bit(channel);

    /*@ loop invariant 0 <= i <= voter->config.sensors;
      @ loop assigns i, imu->used[0 .. KEEL_VOTER_SENSORS - 1],
      @     imu->latched[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant voter->config.sensors - i;
      @*/
    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        if (voter->vote.reason[i] != KEEL_VOTER_USED) {
            imu->used[i] = (uint8_t)(imu->used[i] & ~bit);
            imu->latched[i] = (uint8_t)((imu->latched[i] | (voter->sensor[i].latched ? bit : 0u)) &
                                        0xFFu);
        }
    }
}

void keel_virtual_imu_step(keel_virtual_imu_t *imu, const keel_virtual_imu_sample_t sample[],
                           uint32_t elapsed_us)
{
    const uint32_t units = imu->channel[0].config.sensors;
    keel_voter_sample_t one[KEEL_VOTER_SENSORS];
    uint32_t oldest_us = 0u;
    bool complete = true;

    //@ assert units: 2 <= units <= KEEL_VOTER_SENSORS;

    /*@ loop invariant 0 <= i <= units;
      @ loop invariant complete ==> \forall integer j; 0 <= j < i ==> one[j].present;
      @ loop invariant \forall integer j; 0 <= j < i ==> one[j].age_us <= oldest_us;
      @ loop assigns i, oldest_us, complete, one[0 .. KEEL_VOTER_SENSORS - 1],
      @     imu->used[0 .. KEEL_VOTER_SENSORS - 1], imu->latched[0 .. KEEL_VOTER_SENSORS - 1];
      @ loop variant units - i;
      @*/
    for (uint32_t i = 0u; i < units; i++) {
        one[i].age_us = sample[i].age_us;
        one[i].present = sample[i].present;
        oldest_us = (sample[i].age_us > oldest_us) ? sample[i].age_us : oldest_us;
        complete = complete && sample[i].present;
        imu->used[i] = KEEL_VIRTUAL_IMU_ALL;
        imu->latched[i] = 0u;
    }
    /*@ loop invariant 0 <= k <= KEEL_VIRTUAL_IMU_CHANNELS;
      @ loop invariant sensors_stay: \forall integer j; k <= j < KEEL_VIRTUAL_IMU_CHANNELS ==>
      @     imu->channel[j].config.sensors == units;
      @ loop invariant \forall integer j; 0 <= j < units ==>
      @     one[j].age_us <= oldest_us && (complete ==> one[j].present);
      @ loop assigns k, one[0 .. KEEL_VOTER_SENSORS - 1], *imu;
      @ loop variant KEEL_VIRTUAL_IMU_CHANNELS - k;
      @*/
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        /*@ loop invariant 0 <= i <= units;
          @ loop invariant \forall integer j; 0 <= j < units ==>
          @     one[j].age_us <= oldest_us && (complete ==> one[j].present);
          @ loop assigns i, one[0 .. KEEL_VOTER_SENSORS - 1];
          @ loop variant units - i;
          @*/
        for (uint32_t i = 0u; i < units; i++) {
            one[i].value = sample[i].value[k];
        }
        keel_voter_scale(&imu->channel[k]);
        if (!complete || !keel_voter_step_unanimous(&imu->channel[k], one, oldest_us)) {
            keel_voter_step(&imu->channel[k], one, elapsed_us);
            keel_voter_reconsider(&imu->channel[k], one);
            note_verdicts(imu, k);
        }
    }
}

keel_status_t keel_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit)
{
    keel_status_t status = KEEL_ERR_STATE;

    if (unit >= imu->channel[0].config.sensors) {
        return KEEL_ERR_SENSORS;
    }
    /*@ loop invariant 0 <= k <= KEEL_VIRTUAL_IMU_CHANNELS;
      @ loop invariant \forall integer j; 0 <= j < KEEL_VIRTUAL_IMU_CHANNELS ==>
      @     imu->channel[j].config.sensors == \at(imu->channel[j].config.sensors, Pre);
      @ loop assigns k, status, imu->channel[0 .. KEEL_VIRTUAL_IMU_CHANNELS - 1];
      @ loop variant KEEL_VIRTUAL_IMU_CHANNELS - k;
      @*/
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        if (keel_voter_readmit(&imu->channel[k], unit) == KEEL_OK) {
            status = KEEL_OK;
        }
    }
    if (status == KEEL_OK) {
        imu->latched[unit] = 0u;
    }
    return status;
}
