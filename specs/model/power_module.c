/* SPDX-License-Identifier: Apache-2.0 */
#include "power_module.h"

/* PMD-001, PMD-002 */
keel_status_t model_power_module_init(keel_power_module_t *module,
                                      const keel_power_module_config_t *config)
{
    const uint64_t reference = config->reference_mv;

    if ((config->reference_mv == 0u) || (config->reference_mv > 5000u)) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->divider == 0u) || (config->divider > 1000000000u)) {
        return KEEL_ERR_LIMITS;
    }
    if ((config->ua_per_v == 0u) || (config->ua_per_v > 1000000000u)) {
        return KEEL_ERR_LIMITS;
    }
    module->voltage = reference * config->divider;
    module->current = reference * config->ua_per_v;
    module->open_mv = config->open_mv;
    return KEEL_OK;
}

/* PMD-003: 4096 counts are the reference; millionths. */
static uint32_t whole_of_counts(uint16_t count, uint64_t full)
{
    const uint64_t most = 4095u;
    const uint64_t counted = (count < most) ? count : most;

    return (uint32_t)(((counted * full) + 2048000000u) / 4096000000u);
}

/* PMD-003 to PMD-005 */
void model_power_module_read(const keel_power_module_t *module, uint16_t voltage, uint16_t current,
                             keel_power_module_reading_t *reading)
{
    const uint32_t voltage_mv = whole_of_counts(voltage, module->voltage);

    reading->voltage_mv = voltage_mv;
    reading->current_ma = whole_of_counts(current, module->current);
    reading->told = ((voltage_mv > module->open_mv) ? 0u : 1u) | ((voltage > 4094u) ? 2u : 0u) |
                    ((current > 4094u) ? 4u : 0u);
}
