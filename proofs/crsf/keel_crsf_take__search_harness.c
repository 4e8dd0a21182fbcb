// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 65 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c specs/model/crsf.c specs/model/framing.c
// replaces: keel_crsf_crc keel_framing_drop
// covers: keel_crsf_take keel_crsf_pass_time take_first take_or_refuse take_whole
//
// The other clauses, without the model: counts, ages, a gap, and how the search goes on, at an
// arbitrary place among the bytes.
#include "crsf_proof.h"

/* As many as before, and one more if so, up to the end. */
static bool counted(uint32_t now, uint32_t before, bool one_more)
{
    return now == ((one_more && (before < UINT32_MAX)) ? (before + 1u) : before);
}

/* 0, or older by the time that passed, up to the end. */
static bool aged(uint32_t now, uint32_t before, uint32_t elapsed_us, bool renewed)
{
    const uint32_t older = (elapsed_us > (UINT32_MAX - before)) ? UINT32_MAX
                                                                : (before + elapsed_us);

    return now == (renewed ? 0u : older);
}

void keel_crsf_take__search_harness(void)
{
    keel_crsf_t crsf = nondet_crsf();
    const keel_crsf_t before = crsf;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    const bool late = framing_late_here(&before.framing, elapsed_us);
    const uint32_t place = nondet_u32();
    keel_crsf_taken_t taken;

    __CPROVER_assume(crsf_valid_here(&crsf) && (place < KEEL_FRAMING_BYTES));
    left_place = place;

    taken = keel_crsf_take(&crsf, byte, elapsed_us);

    __CPROVER_assert(
        counted(crsf.count.channels, before.count.channels, taken == KEEL_CRSF_TOOK_CHANNELS) &&
            counted(crsf.count.links, before.count.links, taken == KEEL_CRSF_TOOK_LINK) &&
            counted(crsf.count.shorts, before.count.shorts, taken == KEEL_CRSF_TOOK_SHORT) &&
            counted(crsf.count.others, before.count.others, taken == KEEL_CRSF_TOOK_OTHER),
        "CRF_008_counts: right frames are counted, by what they are");
    __CPROVER_assert(aged(crsf.channels_age_us, before.channels_age_us, elapsed_us,
                          taken == KEEL_CRSF_TOOK_CHANNELS) &&
                         aged(crsf.link_age_us, before.link_age_us, elapsed_us,
                              taken == KEEL_CRSF_TOOK_LINK),
                     "CRF_009_ages: channels and statistics are new, or older by the time");
    if (late) {
        __CPROVER_assert((taken == KEEL_CRSF_NOTHING) &&
                             (crsf.framing.held ==
                              (framing_header_here(&before.framing, byte) ? 1u : 0u)),
                         "CRF_010_gap: behind a gap nothing is held but this byte, if a header");
    } else if ((taken == KEEL_CRSF_NOTHING) && (before.framing.held > 0u)) {
        const uint32_t n = before.framing.held + 1u - crsf.framing.held;
        const uint32_t from = n + place;

        __CPROVER_assert(crsf.framing.held <= (before.framing.held + 1u),
                         "CRF_011_none_more: as many bytes are held as came, or fewer");
        __CPROVER_assert((place < 1u) || (place >= n) ||
                             !framing_header_here(&before.framing, (place < before.framing.held)
                                                                       ? before.framing.byte[place]
                                                                       : byte),
                         "CRF_011_first: of what went behind the first byte, none is a header");
        __CPROVER_assert((place >= crsf.framing.held) ||
                             (crsf.framing.byte[place] ==
                              ((from < before.framing.held) ? before.framing.byte[from] : byte)),
                         "CRF_011_shifted: and the others stay in their order");
    } else {
        /* A frame was taken, or nothing held before. */
    }
}
