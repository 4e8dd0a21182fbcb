// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/battery.c
// covers: keel_battery_step
//
// Any bit pattern for all that was measured, any valid monitor: one step of the induction that
// keeps all of a monitor finite and within its bounds.
#include "battery_proof.h"

void keel_battery_step__valid_harness(void)
{
    const keel_battery_sample_t sample = any_battery_sample();
    keel_battery_t battery = any_battery_at_all();

    __CPROVER_assume(battery_valid(&battery));

    keel_battery_step(&battery, &sample);

    __CPROVER_assert(battery_counts_valid(&battery), "BAT_015_counts: the counts are in range");
    __CPROVER_assert(battery_values_valid(&battery), "BAT_015_values: so are the numbers");
    __CPROVER_assert(battery_products_valid(&battery), "BAT_015_products: so are products");
}
