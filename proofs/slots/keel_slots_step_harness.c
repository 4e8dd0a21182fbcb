// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// cbmc: --unwindset any_memory.0:31,keel_slots_step_harness.1:31,keel_slots_step_harness.2:31
// cbmc: --unwindset keel_slots_step_harness.3:31,memory_erase.0:16,memory_erase.1:16
// cbmc: --unwindset model_slots_whole.0:12
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_step read_slot write_slot byte_of piece_of byte_to_save bytes_to_save
// covers: go_on_saving write_piece compare_piece confirm_mark clear_slot begin_to_write set_mark
// covers: model_slots_step number_byte get_bytes put_bytes byte_behind_mark mark_is cleared written
// covers: compared marked
//
// Any valid slots on any bytes, any of which may not be readable or not be written: the same as the
// model's in every field and in every byte of the medium.
#include "slots_proof.h"

void keel_slots_step_harness(void)
{
    uint8_t before[MEMORY];
    uint8_t expected_memory[MEMORY];
    uint8_t image[ROOM];
    keel_slots_t slots;
    keel_slots_t model;
    keel_slots_result_t expected;
    keel_slots_result_t result;

    for (uint32_t i = 0u; i < ROOM; i++) {
        image[i] = nondet_u8();
    }
    any_memory();
    is_written[0] = has_erase || is_written[0];
    is_written[SIZE] = has_erase || is_written[SIZE];
    slots = any_slots(image);
    __CPROVER_assume(slots_valid_here(&slots));
    model = slots;
    for (uint32_t i = 0u; i < MEMORY; i++) {
        before[i] = memory[i];
    }
    expected = model_slots_step(&model);
    for (uint32_t i = 0u; i < MEMORY; i++) {
        expected_memory[i] = memory[i];
        memory[i] = before[i];
    }
    power = UINT32_MAX;

    result = keel_slots_step(&slots);

    __CPROVER_assert(result == expected, "SLT_007_model: it goes on or ends as the model says");
    __CPROVER_assert(slots_same(&slots, &model), "SLT_008_model: every field as the model says");
    for (uint32_t i = 0u; i < MEMORY; i++) {
        __CPROVER_assert(memory[i] == expected_memory[i],
                         "SLT_010_model: every byte of the medium as the model says");
    }
    __CPROVER_assert(slots_valid_here(&slots), "SLT_007_valid: it stays valid");
}
