// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// cbmc: --unwindset any_memory.0:31,begin_save.0:31,memory_erase.0:16,memory_erase.1:16
// cbmc: --unwindset model_slots_whole.0:12,read_set.0:3,crc_of_bytes.0:3
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_step read_slot write_slot byte_of piece_of byte_to_save bytes_to_save
// covers: go_on_saving write_piece compare_piece confirm_mark clear_slot begin_to_write set_mark
//
// Any bytes of a medium, with a set in the second slot or none; any set that is saved then, on a
// medium that works, or writes anything and tells anything of it, as long as it has power. The
// power fails at any byte, or not. Afterwards the old set is loaded or the new one, and the new one
// if the save was told to be done. With the other harness for the other slot: by induction over the
// saves, no cut loses a set.
#include "slots_cut.h"

void keel_slots_step__cut_second_harness(void)
{
    keel_slots_t slots = begin_save(1u);
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    for (uint32_t i = 0u; i < STEPS; i++) {
        if (goes_on(&slots, result, i)) {
            result = keel_slots_step(&slots);
        }
    }
    find_again(result);
}
