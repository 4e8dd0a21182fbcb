/* SPDX-License-Identifier: Apache-2.0 */
#include "battery/monitor.h"

keel_status_t battery_monitor_init(battery_monitor_t *monitor, uint16_t limit_mv)
{
    if (limit_mv == 0u) {
        return KEEL_ERR_LIMITS;
    }
    monitor->limit_mv = limit_mv;
    monitor->low = 0u;
    monitor->alarm = false;
    return KEEL_OK;
}

bool battery_monitor_step(battery_monitor_t *monitor, uint16_t voltage_mv)
{
    if (voltage_mv >= monitor->limit_mv) {
        monitor->low = 0u;
    } else if (monitor->low < BATTERY_MONITOR_SAMPLES) {
        monitor->low++;
    } else {
        /* Low for long: the count says so already. */
    }
    if (monitor->low == BATTERY_MONITOR_SAMPLES) {
        monitor->alarm = true;
    }
    return monitor->alarm;
}
