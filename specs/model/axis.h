/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis.h
 * @brief What the functions of keel/flight/axis.h do.
 */
#ifndef MODEL_AXIS_H
#define MODEL_AXIS_H

#include "keel/flight/axis.h"

keel_status_t model_axis_init(keel_axis_t *axis, const keel_axis_config_t *config);

void model_axis_restart(keel_axis_t *axis);

void model_axis_step(keel_axis_t *axis, const keel_axis_sample_t *sample);

#endif
