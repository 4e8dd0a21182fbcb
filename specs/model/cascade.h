/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cascade.h
 * @brief What the functions of keel/flight/cascade.h do.
 */
#ifndef MODEL_CASCADE_H
#define MODEL_CASCADE_H

#include "keel/flight/cascade.h"

keel_status_t model_cascade_check(const keel_cascade_config_t *config, uint32_t axis);

keel_status_t model_cascade_init(keel_cascade_t *cascade, const keel_cascade_config_t *config);

void model_cascade_enter(keel_cascade_t *cascade, uint8_t mode);

void model_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input);

void model_cascade_rate_step(keel_cascade_t *cascade, keel_cascade_rates_t asked,
                             keel_attitude_vector_t rate, uint32_t gave_way);

void model_cascade_angle_step(keel_cascade_t *cascade, keel_cascade_tilt_t asked,
                              keel_attitude_vector_t down, bool valid);

void model_cascade_velocity_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                 const keel_cascade_estimate_t *estimate);

void model_cascade_position_step(keel_cascade_t *cascade, keel_cascade_vector_t asked,
                                 const keel_cascade_estimate_t *estimate);

#endif
