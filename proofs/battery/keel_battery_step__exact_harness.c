// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/battery.c
// covers: keel_battery_step
//
// As keel_battery_step__clauses_harness: the sum of charge grows by exactly the quanta of the
// current, and stays at its end when that is more than it has room for.
#include "battery_proof.h"

void keel_battery_step__exact_harness(void)
{
    const keel_battery_sample_t sample = any_battery_sample();
    const uint64_t end = (((uint64_t)UINT32_MAX + 1u) * KEEL_BATTERY_QUANTA) - 1u;
    keel_battery_t battery = any_battery_at_all();
    uint64_t sum;
    uint64_t is;

    __CPROVER_assume(battery_valid(&battery));
    sum = ((uint64_t)battery.charge.whole * KEEL_BATTERY_QUANTA) + battery.charge.part;

    keel_battery_step(&battery, &sample);

    sum += (uint32_t)(battery.current * 0x1p20f);
    is = ((uint64_t)battery.charge.whole * KEEL_BATTERY_QUANTA) + battery.charge.part;
    __CPROVER_assert(is == ((sum < end) ? sum : end),
                     "BAT_007_exact: no increment is lost, however small");
}
