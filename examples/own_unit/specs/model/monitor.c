/* SPDX-License-Identifier: Apache-2.0 */
#include "monitor.h"

keel_status_t model_battery_monitor_init(battery_monitor_t *monitor, uint16_t limit_mv)
{
    const battery_monitor_t fresh = {limit_mv, 0u, false};

    if (limit_mv != 0u) {
        *monitor = fresh;
    }
    return (limit_mv != 0u) ? KEEL_OK : KEEL_ERR_LIMITS;
}

bool model_battery_monitor_step(battery_monitor_t *monitor, uint16_t voltage_mv)
{
    const bool is_low = voltage_mv < monitor->limit_mv;
    const uint8_t before = monitor->low;
    const bool was_full = before == BATTERY_MONITOR_SAMPLES;

    monitor->low = !is_low ? 0u : was_full ? before : (uint8_t)(before + 1u);
    monitor->alarm = monitor->alarm || (monitor->low == BATTERY_MONITOR_SAMPLES);
    return monitor->alarm;
}
