// SPDX-License-Identifier: Apache-2.0
// sources: src/battery/monitor.c specs/model/monitor.c
// covers: battery_monitor_init model_battery_monitor_init
#include "proof.h"

void battery_monitor_init_harness(void)
{
    const uint16_t limit_mv = nondet_u16();
    battery_monitor_t monitor = nondet_monitor();
    battery_monitor_t expected = monitor;
    keel_status_t status;

    status = battery_monitor_init(&monitor, limit_mv);

    __CPROVER_assert(status == model_battery_monitor_init(&expected, limit_mv),
                     "BAT_001_status: as the model says");
    __CPROVER_assert(monitor_same(&monitor, &expected), "BAT_001_model: as the model says");
}
