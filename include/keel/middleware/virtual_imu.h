/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file virtual_imu.h
 * @brief A virtual inertial measurement unit: a voter per channel over 2 to 4 redundant units.
 *
 * The six channels, three of the accelerometer and three of the gyroscope, vote each on its own
 * (voter.h), with thresholds that grow with its last output. Per unit it is kept which of its
 * channels contributed to the last vote and which are latched as faulty. The caller takes vibration
 * out of the samples before: the voter compares units, and vibration differs from one to the next.
 */
#ifndef KEEL_MIDDLEWARE_VIRTUAL_IMU_H
#define KEEL_MIDDLEWARE_VIRTUAL_IMU_H

#include "keel/c_declarations.h"
#include "keel/middleware/voter.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Channels of a unit: accelerometer x, y, z in m/s^2, then gyroscope x, y, z in rad/s. */
#define KEEL_VIRTUAL_IMU_CHANNELS 6u
/** How many of them are the accelerometer's. */
#define KEEL_VIRTUAL_IMU_ACCELEROMETER 3u
/** The verdict of a unit with all channels: a bit per channel, channel 0 the lowest. */
#define KEEL_VIRTUAL_IMU_ALL 0x3Fu

/** How the units vote. */
typedef struct keel_virtual_imu_config {
    keel_voter_config_t accelerometer; /**< Of channels 0 to 2, in m/s^2. */
    keel_voter_config_t gyroscope;     /**< Of channels 3 to 5, in rad/s; as many sensors. */
} keel_virtual_imu_config_t;

/** A unit's measurement. Values may be any bit pattern. */
typedef struct keel_virtual_imu_sample {
    float value[KEEL_VIRTUAL_IMU_CHANNELS]; /**< In m/s^2 and rad/s. */
    uint32_t age_us;                        /**< How long ago, in us. */
    bool present;                           /**< Whether the unit gave a sample. */
} keel_virtual_imu_sample_t;

/** A virtual unit. Only the functions below write it; all of it may be read. */
typedef struct keel_virtual_imu {
    keel_voter_t channel[KEEL_VIRTUAL_IMU_CHANNELS]; /**< The output is channel[k].vote.output. */
    uint8_t used[KEEL_VOTER_SENSORS];    /**< Per unit: its channels that contributed. */
    uint8_t latched[KEEL_VOTER_SENSORS]; /**< Per unit: its channels latched as faulty. */
} keel_virtual_imu_t;

/**
 * Makes a virtual unit ready for its first vote (requirement IMU-001). Each channel is then as
 * keel_voter_init makes it, with the configuration of its kind.
 *
 * @param imu    the virtual unit
 * @param config how it votes
 * @return KEEL_OK; what keel_voter_check says of the accelerometer's configuration, or else of the
 *         gyroscope's; KEEL_ERR_SENSORS when they do not have as many sensors. Nothing changes then
 */
keel_status_t keel_virtual_imu_init(keel_virtual_imu_t *imu,
                                    const keel_virtual_imu_config_t *config);

/**
 * Takes a vote on each channel (requirements IMU-002, IMU-003, IMU-005 and IMU-006): on channel k,
 * each unit's value[k] with the unit's age and presence, as keel_voter_step takes it once
 * keel_voter_scale has set the channel's thresholds by its last output. keel_voter_reconsider then
 * readmits what is latched and has agreed for long enough.
 *
 * @param imu        the virtual unit, initialised
 * @param sample     a sample per unit, N of them, in the order of the units
 * @param elapsed_us the time since the last vote, in us
 */
void keel_virtual_imu_step(keel_virtual_imu_t *imu, const keel_virtual_imu_sample_t sample[],
                           uint32_t elapsed_us);

/**
 * Readmits all latched channels of a unit (requirement IMU-004). Which channels contributed to the
 * last vote stays noted.
 *
 * @param imu  the virtual unit
 * @param unit the unit's index
 * @return KEEL_OK; KEEL_ERR_SENSORS when there is no such unit, KEEL_ERR_STATE when none of its
 *         channels is latched: then nothing changes
 */
keel_status_t keel_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit);

KEEL_C_END

#endif
