/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/power_module.h"

#include <stdbool.h>

/* The counts of a reference, in millionths, and half of it to round. */
#define FULL_COUNT 4096000000u
#define HALF_COUNT 2048000000u

/*@ assigns \nothing;
  @ ensures \result <==> 1 <= value <= most;
  @*/
static bool is_scale(uint32_t value, uint32_t most)
{
    return (value >= 1u) && (value <= most);
}

/*@ requires full <= power_module_most;
  @ assigns \nothing;
  @ ensures \result == power_module_scaled(count, full);
  @*/
static uint32_t scaled_count(uint16_t count, uint64_t full)
{
    const uint64_t most = KEEL_POWER_MODULE_COUNT_MAX;
    const uint64_t counted = (count < most) ? count : most;

    return (uint32_t)(((counted * full) + HALF_COUNT) / FULL_COUNT);
}

keel_status_t keel_power_module_init(keel_power_module_t *module,
                                     const keel_power_module_config_t *config)
{
    if (!is_scale(config->reference_mv, KEEL_POWER_MODULE_REFERENCE_MAX) ||
        !is_scale(config->divider, KEEL_POWER_MODULE_SCALE_MAX) ||
        !is_scale(config->ua_per_v, KEEL_POWER_MODULE_SCALE_MAX)) {
        return KEEL_ERR_LIMITS;
    }
    module->voltage = (uint64_t)config->reference_mv * config->divider;
    module->current = (uint64_t)config->reference_mv * config->ua_per_v;
    module->open_mv = config->open_mv;
    return KEEL_OK;
}

void keel_power_module_read(const keel_power_module_t *module, uint16_t voltage, uint16_t current,
                            keel_power_module_reading_t *reading)
{
    uint32_t told = 0u;

    reading->voltage_mv = scaled_count(voltage, module->voltage);
    reading->current_ma = scaled_count(current, module->current);
    if (reading->voltage_mv <= module->open_mv) {
        told += (uint32_t)KEEL_POWER_MODULE_OPEN;
    }
    if (voltage >= (uint16_t)KEEL_POWER_MODULE_COUNT_MAX) {
        told += (uint32_t)KEEL_POWER_MODULE_TOP_VOLTAGE;
    }
    if (current >= (uint16_t)KEEL_POWER_MODULE_COUNT_MAX) {
        told += (uint32_t)KEEL_POWER_MODULE_TOP_CURRENT;
    }
    reading->told = told;
}
