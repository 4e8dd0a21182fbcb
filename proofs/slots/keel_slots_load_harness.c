// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// cbmc: --unwindset any_memory.0:31,read_set.0:3,crc_of_bytes.0:3,take_set.2:3
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_load read_slot read_head forget_slot number_of byte_of piece_of crc_of_bytes crc_of_number
// covers: read_set load_slot newer_slot
// covers: model_slots_load number_byte number_at get_bytes head_of take_set
//
// Any bytes of a medium, any of which may not be readable: the same as the model's in every field.
#include "slots_proof.h"

void keel_slots_load_harness(void)
{
    uint8_t image[ROOM];
    uint8_t model_image[ROOM];
    uint32_t length = nondet_u32();
    uint32_t model_length = length;
    keel_slots_t slots;
    keel_slots_t model;
    keel_slots_result_t expected;
    keel_slots_result_t result;

    any_memory();
    slots = any_slots(NULL);
    model = slots;
    __CPROVER_assume(slots_valid_here(&slots));
    expected = model_slots_load(&model, model_image, &model_length);

    result = keel_slots_load(&slots, image, &length);

    __CPROVER_assert(result == expected, "SLT_003_model: there is a set where the model finds one");
    __CPROVER_assert(slots_same(&slots, &model), "SLT_005_model: every field as the model says");
    __CPROVER_assert(length == model_length, "SLT_003_length: of the same length");
    for (uint32_t i = 0u; i < ROOM; i++) {
        __CPROVER_assert((result != KEEL_SLOTS_DONE) || (i >= length) ||
                             (image[i] == model_image[i]),
                         "SLT_003_bytes: of the same bytes");
    }
    __CPROVER_assert(slots_valid_here(&slots), "SLT_003_valid: it is valid");
}
