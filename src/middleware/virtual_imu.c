#include "keel/middleware/virtual_imu.h"

keel_status_t keel_virtual_imu_init(keel_virtual_imu_t *imu, const keel_imu_config_t *config)
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
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        /* Both are valid, so this refuses nothing. */
        (void)keel_voter_init(&imu->channel[k], (k < KEEL_IMU_ACCELEROMETER)
                                                    ? &config->accelerometer
                                                    : &config->gyroscope);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        imu->used[i] = 0u;
        imu->latched[i] = 0u;
    }
    return KEEL_OK;
}

/* Notes the verdicts of a channel's last vote. Of a sensor that contributed there is none. */
static void note(keel_virtual_imu_t *imu, uint32_t channel)
{
    const keel_voter_t *const voter = &imu->channel[channel];
    const uint32_t bit = 1u << channel;

    for (uint32_t i = 0u; i < voter->config.sensors; i++) {
        if (voter->vote.reason[i] != KEEL_VOTER_USED) {
            imu->used[i] = (uint8_t)(imu->used[i] & ~bit);
            imu->latched[i] = (uint8_t)(imu->latched[i] | (voter->sensor[i].latched ? bit : 0u));
        }
    }
}

void keel_virtual_imu_step(keel_virtual_imu_t *imu, const keel_imu_sample_t sample[],
                           uint32_t elapsed_us)
{
    const uint32_t units = imu->channel[0].config.sensors;
    keel_voter_sample_t one[KEEL_VOTER_SENSORS];
    uint32_t oldest_us = 0u;
    bool complete = true;

    for (uint32_t i = 0u; i < units; i++) {
        one[i].age_us = sample[i].age_us;
        one[i].present = sample[i].present;
        oldest_us = (sample[i].age_us > oldest_us) ? sample[i].age_us : oldest_us;
        complete = complete && sample[i].present;
        imu->used[i] = KEEL_IMU_ALL;
        imu->latched[i] = 0u;
    }
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        for (uint32_t i = 0u; i < units; i++) {
            one[i].value = sample[i].value[k];
        }
        if (!complete || !keel_voter_step_unanimous(&imu->channel[k], one, oldest_us)) {
            keel_voter_step(&imu->channel[k], one, elapsed_us);
            note(imu, k);
        }
    }
}

keel_status_t keel_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit)
{
    keel_status_t status = KEEL_ERR_STATE;

    if (unit >= imu->channel[0].config.sensors) {
        return KEEL_ERR_SENSORS;
    }
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        if (keel_voter_readmit(&imu->channel[k], unit) == KEEL_OK) {
            status = KEEL_OK;
        }
    }
    imu->latched[unit] = 0u;
    return status;
}
