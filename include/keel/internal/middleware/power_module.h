/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/power_module.h
 * @brief The contracts of power_module.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_POWER_MODULE_H
#define KEEL_INTERNAL_MIDDLEWARE_POWER_MODULE_H

#include "keel/c_declarations.h"
#include "keel/middleware/power_module.h"

KEEL_C_BEGIN

/*@ predicate power_module_config(keel_power_module_config_t *c) =
  @     1 <= c->reference_mv <= KEEL_POWER_MODULE_REFERENCE_MAX &&
  @     1 <= c->divider <= KEEL_POWER_MODULE_SCALE_MAX &&
  @     1 <= c->ua_per_v <= KEEL_POWER_MODULE_SCALE_MAX;
  @
  @ logic integer power_module_most =
  @     KEEL_POWER_MODULE_REFERENCE_MAX * KEEL_POWER_MODULE_SCALE_MAX;
  @
  @ predicate power_module_valid(keel_power_module_t *m) =
  @     m->voltage <= power_module_most && m->current <= power_module_most;
  @
  @ // Counts beyond the highest are the highest.
  @ logic integer power_module_count(integer count) =
  @     count < KEEL_POWER_MODULE_COUNT_MAX ? count : KEEL_POWER_MODULE_COUNT_MAX;
  @
  @ // 4096 counts, and millionths.
  @ logic integer power_module_scaled(integer count, integer full) =
  @     (power_module_count(count) * full + 2048000000) / 4096000000;
  @*/

/*@ requires \valid(module) && \valid_read(config) && \separated(module, config);
  @ assigns *module;
  @ behavior limits:
  @   assumes !power_module_config(config);
  @   assigns \nothing;
  @   ensures PMD_001_limits: \result == KEEL_ERR_LIMITS;
  @ behavior made:
  @   assumes power_module_config(config);
  @   ensures PMD_002_made: \result == KEEL_OK && power_module_valid(module) &&
  @       module->voltage == config->reference_mv * config->divider &&
  @       module->current == config->reference_mv * config->ua_per_v &&
  @       module->open_mv == config->open_mv;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_power_module_init(keel_power_module_t *module,
                                     const keel_power_module_config_t *config);

/*@ requires \valid_read(module) && power_module_valid(module) && \valid(reading) &&
  @     \separated(module, reading);
  @ assigns *reading;
  @ ensures PMD_003_voltage: reading->voltage_mv == power_module_scaled(voltage, module->voltage);
  @ ensures PMD_003_current: reading->current_ma == power_module_scaled(current, module->current);
  @ ensures PMD_004_told: reading->told ==
  @     (reading->voltage_mv <= module->open_mv ? KEEL_POWER_MODULE_OPEN : 0) +
  @     (voltage >= KEEL_POWER_MODULE_COUNT_MAX ? KEEL_POWER_MODULE_TOP_VOLTAGE : 0) +
  @     (current >= KEEL_POWER_MODULE_COUNT_MAX ? KEEL_POWER_MODULE_TOP_CURRENT : 0);
  @ ensures PMD_005_full: reading->told >= KEEL_POWER_MODULE_TOP_VOLTAGE <==>
  @     (voltage >= KEEL_POWER_MODULE_COUNT_MAX || current >= KEEL_POWER_MODULE_COUNT_MAX);
  @*/
void keel_power_module_read(const keel_power_module_t *module, uint16_t voltage, uint16_t current,
                            keel_power_module_reading_t *reading);

KEEL_C_END

#endif
