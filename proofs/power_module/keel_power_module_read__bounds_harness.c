// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3
// sources: src/middleware/power_module.c specs/model/power_module.c
// covers: keel_power_module_read scaled_count model_power_module_read whole_of_counts
//
// Any valid module and any counts: nothing overflows, and what is told is of the counts.
#include "power_module_proof.h"

void keel_power_module_read__bounds_harness(void)
{
    const keel_power_module_t module = nondet_power_module();
    const uint16_t voltage = nondet_u16();
    const uint16_t current = nondet_u16();
    keel_power_module_reading_t reading = nondet_power_module_reading();
    keel_power_module_reading_t model;

    __CPROVER_assume(power_module_valid_here(&module));
    model_power_module_read(&module, voltage, current, &model);

    keel_power_module_read(&module, voltage, current, &reading);

    __CPROVER_assert((reading.told & 1u) == ((reading.voltage_mv <= module.open_mv) ? 1u : 0u),
                     "PMD_004_open: an input with nothing on it is told");
    __CPROVER_assert((reading.told >> 1) ==
                         (((voltage >= 4095u) ? 1u : 0u) + ((current >= 4095u) ? 2u : 0u)),
                     "PMD_005_top: a full count is told");
}
