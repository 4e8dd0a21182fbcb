// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_take keel_ubx_pass_time begin_message take_data take_message go_on_with
// covers: gather model_ubx_fix number_at
//
// Any right NAV-PVT, and any of its bytes, none of which but the first comes after a gap.
//
// After the first five bytes, of any valid decoder, the window ends with what came of the header,
// unless a right message ended with one of them; which none does when the first came after a gap.
// The sixth begins it, whatever was under way. From then on what came of it is held, unless its
// header comes again in it; and its last byte takes it. So by induction over its 100 bytes every
// right one is taken by its last byte, whatever was before, but in these two cases.
#include "ubx_proof.h"

/* The last bytes of its fields, and whether each that has come is what the payload says. */
static bool holds_fields(const keel_ubx_fix_t *is, const uint8_t *payload, uint32_t came)
{
    const keel_ubx_fix_t says = model_ubx_fix(payload);

    return ((came <= 3u) || (is->tow_ms == says.tow_ms)) &&
           ((came <= 23u) || ((is->type == says.type) && (is->is_ok == says.is_ok) &&
                              (is->satellites == says.satellites))) &&
           ((came <= 27u) || (is->longitude == says.longitude)) &&
           ((came <= 31u) || (is->latitude == says.latitude)) &&
           ((came <= 39u) || (is->height_mm == says.height_mm)) &&
           ((came <= 43u) || (is->accuracy_mm == says.accuracy_mm)) &&
           ((came <= 47u) || (is->height_accuracy == says.height_accuracy)) &&
           ((came <= 51u) || (is->north == says.north)) &&
           ((came <= 55u) || (is->east == says.east)) &&
           ((came <= 59u) || (is->down == says.down)) &&
           ((came <= 71u) || (is->speed_accuracy == says.speed_accuracy)) &&
           ((came <= 79u) || (is->is_invalid == says.is_invalid));
}

/* Whether the window ends with so many bytes of it, six at most. */
static bool sees_last(const keel_ubx_t *u, const uint8_t *frame, uint32_t count)
{
    bool sees = true;

    for (uint32_t j = 1u; j <= 6u; j++) {
        sees = sees && ((j > count) || (((u->window >> (48u - (8u * j))) & 0xFFu) ==
                                        frame[(j > count) ? 0u : (count - j)]));
    }
    return sees;
}

/* Whether so many bytes of it have been taken, with these sums of all of them. */
static bool holds(const keel_ubx_t *u, const uint8_t *frame, uint32_t count, uint8_t a, uint8_t b)
{
    const uint32_t came = (count < 6u) ? 0u : (count - 6u);
    bool holds = sees_last(u, frame, count);

    if (count >= 6u) {
        holds = holds && (u->kind == 1u) && (u->sum_b == b) &&
                ((count == 99u) || (u->sum_a == a)) && holds_fields(&u->pending, &frame[6], came);
        holds = holds && (u->step == ((came < 92u) ? 1u : ((came == 92u) ? 2u : 3u))) &&
                ((came > 92u) || (u->left == (92u - came)));
    }
    return holds;
}

/* Whether nothing but so many bytes of its header has come since a gap. */
static bool is_clean(const keel_ubx_t *u, uint32_t count)
{
    const uint64_t header = 0x005C070162B5u;

    return (u->step == 0u) && (u->window == ((header << (48u - (8u * count))) & 0xFFFFFFFFFFFFu));
}

void keel_ubx_take__fix_harness(void)
{
    static const uint8_t header[6] = {0xB5, 0x62, 0x01, 0x07, 0x5C, 0x00};
    keel_ubx_t ubx = any_ubx();
    const keel_ubx_t before = ubx;
    uint8_t frame[KEEL_UBX_BYTES];
    const uint32_t count = nondet_u32();
    const uint32_t elapsed_us = nondet_u32();
    uint8_t a = nondet_u8();
    uint8_t b = nondet_u8();
    bool again = count >= 6u;
    bool ends;
    bool clean;
    bool gap;
    bool is_fix;

    __CPROVER_havoc_object(frame);
    __CPROVER_assume(ubx_valid_here(&ubx) && (count < 100u));
    for (uint32_t i = 0u; i < 6u; i++) {
        __CPROVER_assume(frame[i] == header[i]);
    }
    for (uint32_t i = 0u; i < 6u; i++) {
        again = again && (frame[again ? ((count - 5u) + i) : 0u] == header[i]);
    }
    gap = is_gap(&ubx, elapsed_us);
    /* The sums of the bytes that came: the header's, all of them in the checksum. */
    __CPROVER_assume((count != 98u) || (a == frame[98]));
    __CPROVER_assume((count != 99u) || (b == frame[99]));
    __CPROVER_assume(holds(&ubx, frame, count, a, b));
    __CPROVER_assume((count == 0u) || !gap);
    __CPROVER_assume(!again || (count == 99u));
    ends = (ubx.step == 3u) && (frame[count] == ubx.sum_b) && !gap;
    clean = (count == 0u) ? gap : ((count < 6u) && is_clean(&ubx, count));

    is_fix = keel_ubx_take(&ubx, frame[count], elapsed_us);

    if (count < 5u) {
        __CPROVER_assert(ends || holds(&ubx, frame, count + 1u, a, b),
                         "UBX_010_header: what came of the header is seen");
        __CPROVER_assert(!clean || (!ends && is_clean(&ubx, count + 1u)),
                         "UBX_009_clean: after a gap there is nothing else");
    } else if (count == 5u) {
        __CPROVER_assert(ends || holds(&ubx, frame, 6u, 0x64u, 0xD1u),
                         "UBX_010_begins: its last byte begins it");
        __CPROVER_assert(!clean || !ends, "UBX_009_begins: after a gap it does");
    } else if (count < 98u) {
        a = (uint8_t)((a + frame[count]) % 256u);
        b = (uint8_t)((b + a) % 256u);
        __CPROVER_assert(!is_fix && holds(&ubx, frame, count + 1u, a, b),
                         "UBX_005_step: one more byte of it is held");
    } else if (count == 98u) {
        __CPROVER_assert(!is_fix && holds(&ubx, frame, 99u, a, b),
                         "UBX_004_half: half of the checksum is right");
    } else {
        const keel_ubx_fix_t says = model_ubx_fix(&frame[6]);

        __CPROVER_assert(is_fix && ubx_fix_same(&ubx.fix, &says) && (ubx.age_us == 0u),
                         "UBX_005_taken: its last byte takes it, and this is what it says");
        __CPROVER_assert(ubx.count.fixes >= before.count.fixes, "UBX_007_counted: it is counted");
    }
}
