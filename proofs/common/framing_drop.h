/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file framing_drop.h
 * @brief What stands for keel_framing_drop, and for its model, in the harnesses of decoders:
 *        whatever its contract allows may be left. When the model drops bytes, the code must drop
 *        as many of the same, and is left the same. At left_place, if a harness chooses one, what
 *        is left is what the contract says (FRG_006_first, FRG_006_shifted).
 */
#ifndef FRAMING_DROP_H
#define FRAMING_DROP_H

#include "../../specs/model/framing.h"
#include "framing_contracts.h"

static bool told_of_drop;
static uint32_t told_drop;
static keel_framing_t told_before;
static keel_framing_t told_after;
static uint32_t left_place = KEEL_FRAMING_BYTES;

static void any_left(keel_framing_t *framing)
{
    framing->held = nondet_u8();
    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        framing->byte[i] = nondet_u8();
    }
}

void model_framing_drop(keel_framing_t *framing, uint32_t count)
{
    told_of_drop = true;
    told_drop = count;
    told_before = *framing;
    any_left(framing);
    __CPROVER_assume(keel_framing_drop_does(framing, told_before.held, count));
    told_after = *framing;
}

/* Whether the model, if it has dropped bytes, dropped as many of the same. It is no part of the
 * assertion: the search for what reaches the assertion's blocks would have to show that nothing
 * makes it false. */
static bool drops_as_told(const keel_framing_t *framing, uint32_t count, uint32_t at)
{
    return !told_of_drop || ((count == told_drop) && framing_same(framing, &told_before, at));
}

void keel_framing_drop_stand_in(keel_framing_t *framing, uint32_t count)
{
    const keel_framing_t before = *framing;
    const uint32_t at = any_below(KEEL_FRAMING_BYTES);

    __CPROVER_assert(keel_framing_drop_may(framing, count), "precondition: keel_framing_drop");
    __CPROVER_assert(drops_as_told(framing, count, at),
                     "FRG_006_drop: as many of the same bytes as the model");
    if (told_of_drop) {
        *framing = told_after;
    } else {
        any_left(framing);
    }
    __CPROVER_assume(keel_framing_drop_does(framing, before.held, count));
    __CPROVER_assume(framing_left_at(framing, &before, count, left_place));
}

/* Whether so many bytes of a frame are held from the beginning on. */
static bool framing_holds(const keel_framing_t *f, const uint8_t *frame, uint32_t count)
{
    bool same = count <= f->held;

    for (uint32_t i = 0u; i < KEEL_FRAMING_BYTES; i++) {
        same = same && ((i >= count) || (f->byte[i] == frame[i]));
    }
    return same;
}

#endif
