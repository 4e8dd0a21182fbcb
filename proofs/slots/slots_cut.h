/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file slots_cut.h
 * @brief A save whose power fails: what was before, what is saved, and what is found afterwards.
 *
 * The check is the sum of all bytes, without carries: a mixture of two sets often passes it.
 */
#ifndef SLOTS_CUT_H
#define SLOTS_CUT_H

#define SUM_AS_CHECK
#include "slots_proof.h"

/* The steps of a save: which stage each is, and at which byte it begins. */
#define STEPS 6u

static const keel_slots_stage_t stage_of[STEPS] = {KEEL_SLOTS_CLEARING,  KEEL_SLOTS_WRITING,
                                                   KEEL_SLOTS_WRITING,   KEEL_SLOTS_COMPARING,
                                                   KEEL_SLOTS_COMPARING, KEEL_SLOTS_MARKING};
static const uint32_t at_of[STEPS] = {0u, 0u, 8u, 0u, 8u, 0u};

/* A set as it was loaded or is saved. */
typedef struct set {
    uint8_t image[ROOM];
    uint32_t length;
} set_t;

static set_t old_set;
static set_t new_set;
static keel_slots_result_t found_before;

static bool set_same(const set_t *a, const set_t *b)
{
    bool same = a->length == b->length;

    for (uint32_t i = 0u; i < ROOM; i++) {
        same = same && ((i >= a->length) || (a->image[i] == b->image[i]));
    }
    return same;
}

/* Slots that begin to save any set, on a memory of any bytes, which works until its power fails, or
 * has any faults until then; the newest set is in this slot, or there is none. */
static keel_slots_t begin_save(uint32_t newest)
{
    keel_slots_t slots;

    any_memory();
    for (uint32_t i = 0u; i < MEMORY; i++) {
        is_read[i] = true;
        is_written[i] = true;
    }
    for (uint32_t i = 0u; i < ROOM; i++) {
        new_set.image[i] = nondet_u8();
    }
    new_set.length = nondet_u32();
    slots = any_slots(NULL);
    slots.config.address[0] = 0u;
    slots.config.address[1] = SIZE;
    __CPROVER_assume(slots_valid_here(&slots));
    found_before = keel_slots_load(&slots, old_set.image, &old_set.length);
    __CPROVER_assume((slots.newest == newest) &&
                     (keel_slots_begin(&slots, new_set.image, new_set.length) == KEEL_OK));
    slots.newest = newest;
    is_honest = nondet_bool();
    power = nondet_u32();
    return slots;
}

/* Whether there is another step: it is this one. */
static bool goes_on(keel_slots_t *slots, keel_slots_result_t result, uint32_t step)
{
    const bool goes = (result == KEEL_SLOTS_BUSY) && !is_off;

    if (goes) {
        __CPROVER_assert((slots->stage == stage_of[step]) && (slots->at == at_of[step]),
                         "SLT_010_stages: one stage after the other");
        slots->stage = stage_of[step]; /* Now the search knows it, too. */
        slots->at = at_of[step];
    }
    return goes;
}

/* After the last step, and another start. */
static void find_again(keel_slots_result_t last)
{
    const keel_slots_result_t result = is_off ? KEEL_SLOTS_BUSY : last;
    set_t after = {.length = 0u};
    keel_slots_t slots = any_slots(NULL);
    keel_slots_result_t found;
    bool is_old;
    bool is_new;

    __CPROVER_assert(is_off || (result != KEEL_SLOTS_BUSY), "SLT_011_ends: the save ends");
    __CPROVER_assert(is_off || !is_honest || (result == KEEL_SLOTS_DONE),
                     "SLT_009_done: on a medium that works it succeeds");
    is_off = false;
    slots.config.address[0] = 0u;
    slots.config.address[1] = SIZE;
    __CPROVER_assume(slots_valid_here(&slots));
    found = keel_slots_load(&slots, after.image, &after.length);
    is_old = (found_before == KEEL_SLOTS_DONE) && set_same(&after, &old_set);
    is_new = set_same(&after, &new_set);
    __CPROVER_assert((found_before != KEEL_SLOTS_DONE) || (found == KEEL_SLOTS_DONE),
                     "SLT_010_kept: when there was a set, there is one");
    __CPROVER_assert((found != KEEL_SLOTS_DONE) || is_old || is_new,
                     "SLT_010_either: it is the old one or the new one");
    __CPROVER_assert((result != KEEL_SLOTS_DONE) || ((found == KEEL_SLOTS_DONE) && is_new),
                     "SLT_010_new: when the save is done, the new one");
}

#endif
