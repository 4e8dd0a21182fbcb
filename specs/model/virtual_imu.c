/* SPDX-License-Identifier: Apache-2.0 */
#include "virtual_imu.h"

#include "voter.h"

/* IMU-001 */
keel_status_t model_virtual_imu_init(keel_virtual_imu_t *imu,
                                     const keel_virtual_imu_config_t *config)
{
    const keel_status_t accelerometer = model_voter_check(&config->accelerometer);
    const keel_status_t gyroscope = model_voter_check(&config->gyroscope);

    if (accelerometer != KEEL_OK) {
        return accelerometer;
    }
    if (gyroscope != KEEL_OK) {
        return gyroscope;
    }
    if (config->accelerometer.sensors != config->gyroscope.sensors) {
        return KEEL_ERR_SENSORS;
    }
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_ACCELEROMETER; k++) {
        (void)model_voter_init(&imu->channel[k], &config->accelerometer);
    }
    for (uint32_t k = KEEL_VIRTUAL_IMU_ACCELEROMETER; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        (void)model_voter_init(&imu->channel[k], &config->gyroscope);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        imu->used[i] = 0u;
        imu->latched[i] = 0u;
    }
    return KEEL_OK;
}

/* A whole vote of one channel: of each unit its value of that channel, with the unit's age and
 * presence, by thresholds after the channel's last output; then the probation of what is latched.
 * IMU-002, IMU-005, IMU-006 */
static void vote(keel_virtual_imu_t *imu, uint32_t channel,
                 const keel_virtual_imu_sample_t sample[], uint32_t elapsed_us)
{
    keel_voter_sample_t one[KEEL_VOTER_SENSORS] = {{0.0f, 0u, false}};

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < imu->channel[channel].config.sensors) {
            one[i].value = sample[i].value[channel];
            one[i].age_us = sample[i].age_us;
            one[i].present = sample[i].present;
        }
    }
    model_voter_scale(&imu->channel[channel]);
    model_voter_step(&imu->channel[channel], one, elapsed_us);
    model_voter_reconsider(&imu->channel[channel], one);
}

/* A unit's channels, as bits, that contributed to the last vote. IMU-003 */
static uint8_t used(const keel_virtual_imu_t *imu, uint32_t unit)
{
    uint32_t bits = 0u;

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        bits |= (imu->channel[k].vote.reason[unit] == KEEL_VOTER_USED) ? (1u << k) : 0u;
    }
    return (uint8_t)bits;
}

/* A unit's channels, as bits, that are latched. IMU-003 */
static uint8_t latched(const keel_virtual_imu_t *imu, uint32_t unit)
{
    uint32_t bits = 0u;

    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        bits |= imu->channel[k].sensor[unit].latched ? (1u << k) : 0u;
    }
    return (uint8_t)bits;
}

/* All channels vote first, then the verdicts are noted. */
void model_virtual_imu_step(keel_virtual_imu_t *imu, const keel_virtual_imu_sample_t sample[],
                            uint32_t elapsed_us)
{
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        vote(imu, k, sample, elapsed_us);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < imu->channel[0].config.sensors) {
            imu->used[i] = used(imu, i);
            imu->latched[i] = latched(imu, i);
        }
    }
}

/* IMU-004 */
keel_status_t model_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit)
{
    if (unit >= imu->channel[0].config.sensors) {
        return KEEL_ERR_SENSORS;
    }
    if (latched(imu, unit) == 0u) {
        return KEEL_ERR_STATE;
    }
    for (uint32_t k = 0u; k < KEEL_VIRTUAL_IMU_CHANNELS; k++) {
        (void)model_voter_readmit(&imu->channel[k], unit); /* Refused where it is not latched. */
    }
    imu->latched[unit] = 0u;
    return KEEL_OK;
}
