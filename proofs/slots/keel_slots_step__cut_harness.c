// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 31 --external-sat-solver cadical
// sources: src/middleware/slots.c specs/model/slots.c
// covers: keel_slots_step keel_slots_load keel_slots_begin read_slot write_slot read_head number_of
// covers: byte_of piece_of crc_of_bytes crc_of_number read_set load_slot newer_slot byte_to_save
// covers: bytes_to_save go_on_saving write_piece compare_piece confirm_mark clear_slot
// covers: begin_to_write set_mark
//
// Any bytes of a medium, of which a set is loaded or none; any set that is saved then, on a medium
// that may write anything and tell anything of it, as long as it has power. The power fails at any
// byte, or not. Afterwards the old set is loaded or the new one; none, if none was before; and the
// new one if the save was told to be done. So by induction over the saves no cut loses a set.
#include "slots_proof.h"

#define STEPS 6u

/* A set as it was loaded or saved. */
typedef struct set {
    uint8_t image[ROOM];
    uint32_t length;
} set_t;

static bool set_same(const set_t *a, const set_t *b)
{
    bool same = a->length == b->length;

    for (uint32_t i = 0u; i < ROOM; i++) {
        same = same && ((i >= a->length) || (a->image[i] == b->image[i]));
    }
    return same;
}

static keel_slots_result_t loaded(keel_slots_t *slots, set_t *set)
{
    return keel_slots_load(slots, set->image, &set->length);
}

void keel_slots_step__cut_harness(void)
{
    set_t old = {.length = 0u};
    set_t new = {.length = nondet_u32()};
    set_t after = {.length = 0u};
    keel_slots_t slots;
    keel_slots_t again;
    keel_slots_result_t first;
    keel_slots_result_t second;
    keel_slots_result_t result = KEEL_SLOTS_BUSY;

    for (uint32_t i = 0u; i < ROOM; i++) {
        new.image[i] = nondet_u8();
    }
    any_memory();
    slots = any_slots(NULL);
    __CPROVER_assume(slots_valid_here(&slots));
    again = slots;
    for (uint32_t i = 0u; i < MEMORY; i++) {
        is_read[i] = true;
        is_written[i] = true;
    }
    first = loaded(&slots, &old);
    __CPROVER_assume(keel_slots_begin(&slots, new.image, new.length) == KEEL_OK);
    is_honest = nondet_bool();
    power = nondet_u32();

    for (uint32_t i = 0u; (i < STEPS) && (result == KEEL_SLOTS_BUSY) && !is_off; i++) {
        result = keel_slots_step(&slots);
    }

    __CPROVER_assert(is_off || (result != KEEL_SLOTS_BUSY), "SLT_011_ends: the save ends");
    __CPROVER_assert(is_off || !is_honest || (result == KEEL_SLOTS_DONE),
                     "SLT_009_done: on a medium that works it succeeds");
    result = is_off ? KEEL_SLOTS_BUSY : result;
    is_off = false;
    second = loaded(&again, &after);
    __CPROVER_assert((first != KEEL_SLOTS_DONE) || (second == KEEL_SLOTS_DONE),
                     "SLT_010_kept: when there was a set, there is one");
    __CPROVER_assert((second != KEEL_SLOTS_DONE) || set_same(&after, &new) ||
                         ((first == KEEL_SLOTS_DONE) && set_same(&after, &old)),
                     "SLT_010_either: it is the old one or the new one");
    __CPROVER_assert((result != KEEL_SLOTS_DONE) ||
                         ((second == KEEL_SLOTS_DONE) && set_same(&after, &new)),
                     "SLT_010_new: when the save is done, the new one");
}
