// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3
// sources: src/middleware/power_module.c specs/model/power_module.c
// covers: keel_power_module_init is_scale model_power_module_init
//
// Any configuration: the same as the model's in every field; a refusal changes nothing.
#include "power_module_proof.h"

void keel_power_module_init_harness(void)
{
    const keel_power_module_config_t config = nondet_power_module_config();
    keel_power_module_t module = nondet_power_module();
    keel_power_module_t model = module;
    const keel_power_module_t before = module;
    const keel_status_t expected = model_power_module_init(&model, &config);
    const keel_status_t status = keel_power_module_init(&module, &config);

    __CPROVER_assert(status == expected, "PMD_001_model: taken or refused as the model says");
    __CPROVER_assert(power_module_same(&module, &model),
                     "PMD_002_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) || power_module_same(&module, &before),
                     "STA_001_kept: a refusal changes nothing");
}
