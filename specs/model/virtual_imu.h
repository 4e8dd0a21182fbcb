/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file virtual_imu.h
 * @brief What the functions of keel/middleware/virtual_imu.h do.
 */
#ifndef MODEL_VIRTUAL_IMU_H
#define MODEL_VIRTUAL_IMU_H

#include "keel/middleware/virtual_imu.h"

keel_status_t model_virtual_imu_init(keel_virtual_imu_t *imu,
                                     const keel_virtual_imu_config_t *config);
void model_virtual_imu_step(keel_virtual_imu_t *imu, const keel_virtual_imu_sample_t sample[],
                            uint32_t elapsed_us);
keel_status_t model_virtual_imu_readmit(keel_virtual_imu_t *imu, uint32_t unit);

#endif
