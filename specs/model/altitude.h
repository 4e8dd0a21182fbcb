/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file altitude.h
 * @brief What the functions of keel/flight/altitude.h do.
 */
#ifndef MODEL_ALTITUDE_H
#define MODEL_ALTITUDE_H

#include "keel/flight/altitude.h"

keel_status_t model_altitude_init(keel_altitude_t *altitude, const keel_axis_config_t *config);

void model_altitude_zero(keel_altitude_t *altitude);

void model_altitude_step(keel_altitude_t *altitude, const keel_altitude_sample_t *sample);

#endif
