// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 31 --external-sat-solver cadical
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_init slot_fits forget_slot model_slots_init
//
// Any configuration: the same as the model's in every field.
#include "slots_proof.h"

void keel_slots_init_harness(void)
{
    keel_slots_t slots = any_slots(NULL);
    const keel_slots_t before = slots;
    keel_slots_t model = slots;
    keel_slots_config_t config = nondet_slots_config();
    keel_status_t expected;
    keel_status_t status;

    config.medium = memory_config().medium;
    config.medium.read = nondet_bool() ? config.medium.read : NULL;
    config.medium.write = nondet_bool() ? config.medium.write : NULL;
    expected = model_slots_init(&model, &config);

    status = keel_slots_init(&slots, &config);

    __CPROVER_assert(status == expected, "SLT_001_model: taken or refused as the model says");
    __CPROVER_assert(slots_same(&slots, &model), "SLT_002_model: every field as the model says");
    __CPROVER_assert((status != KEEL_OK) || slots_valid_here(&slots), "SLT_002_valid: it is valid");
    __CPROVER_assert((status == KEEL_OK) || slots_same(&slots, &before),
                     "STA_001_kept: a refusal changes nothing");
}
