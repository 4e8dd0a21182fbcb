// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/ibus.c src/middleware/framing.c specs/model/ibus.c specs/model/framing.c
// replaces: keel_framing_drop
// covers: keel_ibus_take keel_ibus_pass_time
//
// The other clauses, without the model: counts, ages, a gap, and how the search goes on, at an
// arbitrary place among the bytes.
#include "ibus_proof.h"

static keel_ibus_t before;
static uint8_t last;

/* framing_sum */
static uint32_t summed(uint32_t a, uint32_t b)
{
    return ((UINT32_MAX - a) < b) ? UINT32_MAX : (a + b);
}

/* A byte of those held, or the one that came behind them. */
static uint8_t came_at(uint32_t at)
{
    return (at < before.framing.held) ? before.framing.byte[at % KEEL_FRAMING_BYTES] : last;
}

/* Nothing was taken, and no gap ended what was held. */
static void check_search(const keel_ibus_t *ibus, uint32_t place)
{
    const uint32_t gone = before.framing.held + 1u - ibus->framing.held;

    __CPROVER_assert(ibus->framing.held <= (before.framing.held + 1u),
                     "IBU_010_none_more: as many bytes are held as came, or fewer");
    __CPROVER_assert((place < 1u) || (place >= gone) || (came_at(place) != 0x20u),
                     "IBU_010_first: of what went behind the first byte, none is a header");
    __CPROVER_assert((place >= ibus->framing.held) ||
                         (ibus->framing.byte[place] == came_at(gone + place)),
                     "IBU_010_shifted: and the others stay in their order");
}

void keel_ibus_take__search_harness(void)
{
    keel_ibus_t ibus = any_ibus();
    const uint32_t elapsed_us = nondet_u32();
    const uint32_t place = nondet_u32();
    bool late;
    bool right;

    before = ibus;
    last = nondet_u8();
    late = framing_late_here(&before.framing, elapsed_us);
    __CPROVER_assume(ibus_valid_here(&ibus) && (place < KEEL_FRAMING_BYTES));
    left_place = place;

    right = keel_ibus_take(&ibus, last, elapsed_us);

    __CPROVER_assert(ibus_valid_here(&ibus), "IBU_003_valid: it stays valid");
    __CPROVER_assert(ibus.count.frames == summed(before.count.frames, right ? 1u : 0u),
                     "IBU_007_frames: right frames are counted");
    __CPROVER_assert(ibus.age_us == (right ? 0u : summed(before.age_us, elapsed_us)),
                     "IBU_008_age: what was said is new, or older by the time");
    __CPROVER_assert(!late || (!right && (ibus.framing.held == ((last == 0x20u) ? 1u : 0u))),
                     "IBU_009_gap: behind a gap nothing is held but this byte, if a header");
    __CPROVER_assert(!right || ((before.framing.held == 31u) && (ibus.framing.held == 0u)),
                     "IBU_004_whole: a frame that is taken is a whole one");
    if (!right && (before.framing.held > 0u) && !late) {
        check_search(&ibus, place);
    }
}
