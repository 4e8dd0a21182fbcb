// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 31 --external-sat-solver cadical
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_begin model_slots_begin
//
// Any slots, any set: the same as the model's in every field.
#include "slots_proof.h"

void keel_slots_begin_harness(void)
{
    static const uint8_t image[ROOM + 1u];
    keel_slots_t slots = any_slots(NULL);
    const keel_slots_t before = slots;
    keel_slots_t model = slots;
    const uint32_t length = nondet_u32();
    keel_status_t expected;
    keel_status_t status;

    __CPROVER_assume(slots_valid_here(&slots));
    expected = model_slots_begin(&model, image, length);

    status = keel_slots_begin(&slots, image, length);

    __CPROVER_assert(status == expected, "SLT_006_model: begun or refused as the model says");
    __CPROVER_assert(slots_same(&slots, &model), "SLT_006_same: every field as the model says");
    __CPROVER_assert(slots_valid_here(&slots), "SLT_006_valid: it stays valid");
    __CPROVER_assert((status == KEEL_OK) || slots_same(&slots, &before),
                     "STA_001_kept: a refusal changes nothing");
}
