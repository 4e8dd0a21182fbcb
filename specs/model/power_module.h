/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file power_module.h
 * @brief What the functions of keel/middleware/power_module.h do.
 */
#ifndef MODEL_POWER_MODULE_H
#define MODEL_POWER_MODULE_H

#include "keel/middleware/power_module.h"

keel_status_t model_power_module_init(keel_power_module_t *module,
                                      const keel_power_module_config_t *config);
void model_power_module_read(const keel_power_module_t *module, uint16_t voltage, uint16_t current,
                             keel_power_module_reading_t *reading);

#endif
