/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file attitude.h
 * @brief What the functions of keel/flight/attitude.h do.
 */
#ifndef MODEL_ATTITUDE_H
#define MODEL_ATTITUDE_H

#include "keel/flight/attitude.h"

keel_status_t model_attitude_init(keel_attitude_t *attitude, const keel_attitude_config_t *config);

void model_attitude_restart(keel_attitude_t *attitude);

void model_attitude_take(keel_attitude_sample_t *sample, const keel_virtual_imu_t *imu);

void model_attitude_step(keel_attitude_t *attitude, const keel_attitude_sample_t *sample);

bool model_attitude_is_unit(keel_attitude_quaternion_t q);

keel_attitude_vector_t model_attitude_down(const keel_attitude_t *attitude);

#endif
