/* SPDX-License-Identifier: Apache-2.0 */
/* What the harnesses of the monitor share: any valid monitor, and when two are the same. */
#ifndef MONITOR_PROOF_H
#define MONITOR_PROOF_H

#include "../../specs/model/monitor.h"

battery_monitor_t nondet_monitor(void);
uint16_t nondet_u16(void);
bool nondet_bool(void);

static battery_monitor_t any_monitor(void)
{
    battery_monitor_t monitor = nondet_monitor();

    monitor.alarm = nondet_bool(); /* Arbitrary bits may be neither false nor true. */
    __CPROVER_assume(monitor.low <= BATTERY_MONITOR_SAMPLES);
    return monitor;
}

static bool monitor_same(const battery_monitor_t *a, const battery_monitor_t *b)
{
    return (a->limit_mv == b->limit_mv) && (a->low == b->low) && (a->alarm == b->alarm);
}

#endif
