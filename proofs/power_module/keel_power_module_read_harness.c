// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3
// checks: assertions
// sources: src/middleware/power_module.c specs/model/power_module.c
// covers: keel_power_module_read scaled_count model_power_module_read whole_of_counts
//
// Any valid module and any counts: the same as the model's in every field. That nothing overflows
// is checked in keel_power_module_read__bounds_harness.
#include "power_module_proof.h"

void keel_power_module_read_harness(void)
{
    const keel_power_module_t module = nondet_power_module();
    const uint16_t voltage = nondet_u16();
    const uint16_t current = nondet_u16();
    keel_power_module_reading_t reading = nondet_power_module_reading();
    keel_power_module_reading_t model = reading;

    __CPROVER_assume(power_module_valid_here(&module));
    model_power_module_read(&module, voltage, current, &model);

    keel_power_module_read(&module, voltage, current, &reading);

    __CPROVER_assert(power_module_reading_same(&reading, &model),
                     "PMD_003_model: every field is what the model says");
}
