#include "virtual_imu.h"

#include "voter.h"

/* IMU-001 */
keel_status_t model_virtual_imu_init(keel_virtual_imu_t *imu, const keel_imu_config_t *config)
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
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        (void)model_voter_init(&imu->channel[k], (k < KEEL_IMU_ACCELEROMETER)
                                                     ? &config->accelerometer
                                                     : &config->gyroscope);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        imu->used[i] = 0u;
        imu->latched[i] = 0u;
    }
    return KEEL_OK;
}

/* Channel k votes on what each unit measured in it, a unit's age being that of all its channels:
 * IMU-002 */
static void vote(keel_voter_t *channel, uint32_t k, const keel_imu_sample_t sample[],
                 uint32_t elapsed_us)
{
    keel_voter_sample_t one[KEEL_VOTER_SENSORS] = {{0.0f, 0u, false}};

    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < channel->config.sensors) {
            one[i].value = sample[i].value[k];
            one[i].age_us = sample[i].age_us;
            one[i].present = sample[i].present;
        }
    }
    model_voter_step(channel, one, elapsed_us);
}

/* Bit k of a unit's verdicts is channel k's: IMU-003 */
static void judge(keel_virtual_imu_t *imu, uint32_t i)
{
    uint32_t used = 0u;
    uint32_t latched = 0u;

    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        used |= (imu->channel[k].vote.reason[i] == KEEL_VOTER_USED) ? (1u << k) : 0u;
        latched |= imu->channel[k].sensor[i].latched ? (1u << k) : 0u;
    }
    imu->used[i] = (uint8_t)used;
    imu->latched[i] = (uint8_t)latched;
}

void model_virtual_imu_step(keel_virtual_imu_t *imu, const keel_imu_sample_t sample[],
                            uint32_t elapsed_us)
{
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        vote(&imu->channel[k], k, sample, elapsed_us);
    }
    for (uint32_t i = 0u; i < KEEL_VOTER_SENSORS; i++) {
        if (i < imu->channel[0].config.sensors) {
            judge(imu, i);
        }
    }
}

/* IMU-004 */
keel_status_t model_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit)
{
    bool latched = false;

    if (unit >= imu->channel[0].config.sensors) {
        return KEEL_ERR_SENSORS;
    }
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        latched = latched || imu->channel[k].sensor[unit].latched;
    }
    if (!latched) {
        return KEEL_ERR_STATE;
    }
    for (uint32_t k = 0u; k < KEEL_IMU_CHANNELS; k++) {
        (void)model_voter_readmit(&imu->channel[k], unit);
    }
    imu->latched[unit] = 0u;
    return KEEL_OK;
}
