/* SPDX-License-Identifier: Apache-2.0 */
/* What the functions of battery/monitor.h do, as plainly as possible. */
#ifndef MODEL_MONITOR_H
#define MODEL_MONITOR_H

#include "battery/monitor.h"

keel_status_t model_battery_monitor_init(battery_monitor_t *monitor, uint16_t limit_mv);
bool model_battery_monitor_step(battery_monitor_t *monitor, uint16_t voltage_mv);

#endif
