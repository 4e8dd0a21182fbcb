// SPDX-License-Identifier: Apache-2.0
// sources: src/battery/monitor.c specs/model/monitor.c
// covers: battery_monitor_step model_battery_monitor_step
#include "proof.h"

void battery_monitor_step_harness(void)
{
    const uint16_t voltage_mv = nondet_u16();
    battery_monitor_t monitor = any_monitor();
    battery_monitor_t expected = monitor;
    bool alarm;

    alarm = battery_monitor_step(&monitor, voltage_mv);

    __CPROVER_assert(alarm == model_battery_monitor_step(&expected, voltage_mv),
                     "BAT_002_result: as the model says");
    __CPROVER_assert(monitor_same(&monitor, &expected), "BAT_002_model: as the model says");
}
