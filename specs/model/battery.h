/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file battery.h
 * @brief What the functions of keel/flight/battery.h do.
 */
#ifndef MODEL_BATTERY_H
#define MODEL_BATTERY_H

#include "keel/flight/battery.h"

keel_status_t model_battery_init(keel_battery_t *battery, const keel_battery_config_t *config);

keel_status_t model_battery_restart(keel_battery_t *battery, float part);

void model_battery_step(keel_battery_t *battery, const keel_battery_sample_t *sample);

#endif
