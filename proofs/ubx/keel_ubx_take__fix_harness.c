// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 15 --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_take keel_ubx_pass_time begin_message take_data take_message go_on_with
// covers: gather model_ubx_fix number_at
//
// Any right NAV-PVT with a payload of 84 to 100 bytes, and any of its bytes, none of which but the
// first comes after a gap.
//
// After the first five bytes, of any valid decoder, the window ends with what came of the header,
// unless a right message ended with one of them; which none does when the first came after a gap.
// The sixth begins it, whatever was under way, if it has 84 or 92 bytes; of another length, after a
// gap. From then on what came of it is held, unless the header of one of 84 or 92 bytes comes in
// it; and its last byte takes it. So by induction over its bytes every right one of 84 or 92 is
// taken by its last byte, whatever was before, but in these two cases, and of another length after
// a gap.
#include "ubx_proof.h"

#define LONGEST 100u

/* The last bytes of its fields, and whether each that has come is what the payload says. */
static bool holds_fields(const keel_ubx_fix_t *is, const uint8_t *payload, uint32_t length,
                         uint32_t came)
{
    const keel_ubx_fix_t says = model_ubx_fix(payload, length);

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
    const uint32_t length = frame[4];
    const uint32_t came = (count < 6u) ? 0u : (count - 6u);
    bool holds = sees_last(u, frame, count);

    if (count >= 6u) {
        holds = holds && (u->kind == 1u) && (u->length == length) && (u->sum_b == b) &&
                ((came > length) || (u->sum_a == a)) &&
                holds_fields(&u->pending, &frame[6], length, came);
        holds = holds && (u->step == ((came < length) ? 1u : ((came == length) ? 2u : 3u))) &&
                ((came > length) || (u->left == (length - came)));
    }
    return holds;
}

/* Whether nothing but so many bytes of its header has come since a gap. */
static bool is_clean(const keel_ubx_t *u, uint8_t length, uint32_t count)
{
    const uint64_t header = 0x070162B5u + ((uint64_t)length << 32);

    return (u->step == 0u) && (u->window == ((header << (48u - (8u * count))) & 0xFFFFFFFFFFFFu));
}

/* Whether a header of a NAV-PVT of 84 or 92 bytes ends with this byte of it. */
static bool begins_again(const uint8_t *frame, uint32_t count)
{
    static const uint8_t header[4] = {0xB5, 0x62, 0x01, 0x07};
    const uint32_t from = (count < 6u) ? 0u : (count - 5u);
    bool again = (count >= 6u) && ((frame[from + 4u] == 84u) || (frame[from + 4u] == 92u)) &&
                 (frame[from + 5u] == 0u);

    for (uint32_t i = 0u; i < 4u; i++) {
        again = again && (frame[from + i] == header[i]);
    }
    return again;
}

void keel_ubx_take__fix_harness(void)
{
    keel_ubx_t ubx = any_ubx();
    const keel_ubx_t before = ubx;
    uint8_t frame[LONGEST + 8u];
    const uint32_t count = nondet_u32();
    const uint32_t elapsed_us = nondet_u32();
    uint8_t a = nondet_u8();
    uint8_t b = nondet_u8();
    uint32_t length;
    bool ends;
    bool clean;
    bool gap;
    bool is_fix;

    __CPROVER_havoc_object(frame);
    length = frame[4];
    __CPROVER_assume((frame[0] == 0xB5u) && (frame[1] == 0x62u) && (frame[2] == 0x01u) &&
                     (frame[3] == 0x07u) && (frame[5] == 0u));
    __CPROVER_assume((length >= 84u) && (length <= LONGEST));
    __CPROVER_assume(ubx_valid_here(&ubx) && (count < (length + 8u)));
    gap = is_gap(&ubx, elapsed_us);
    /* The sums of the bytes that came: the header's, all of them in the checksum. */
    __CPROVER_assume((count != (length + 6u)) || (a == frame[length + 6u]));
    __CPROVER_assume((count != (length + 7u)) || (b == frame[length + 7u]));
    __CPROVER_assume(holds(&ubx, frame, count, a, b));
    __CPROVER_assume((count == 0u) || !gap);
    __CPROVER_assume(!begins_again(frame, count) || (count == (length + 7u)));
    ends = (ubx.step == 3u) && (frame[count] == ubx.sum_b) && !gap;
    clean = (count == 0u) ? gap : ((count < 6u) && is_clean(&ubx, frame[4], count));
    __CPROVER_assume((length == 84u) || (length == 92u) || (count >= 6u) || clean);

    is_fix = keel_ubx_take(&ubx, frame[count], elapsed_us);

    if (count < 5u) {
        __CPROVER_assert(ends || holds(&ubx, frame, count + 1u, a, b),
                         "UBX_010_header: what came of the header is seen");
        __CPROVER_assert(!clean || (!ends && is_clean(&ubx, frame[4], count + 1u)),
                         "UBX_009_clean: after a gap there is nothing else");
    } else if (count == 5u) {
        a = (uint8_t)((8u + length) % 256u); /* 01 07 length 00, summed up by hand. */
        b = (uint8_t)((25u + (2u * length)) % 256u);
        __CPROVER_assert(ends || holds(&ubx, frame, 6u, a, b),
                         "UBX_010_begins: its last byte begins it");
        __CPROVER_assert(!clean || !ends, "UBX_009_begins: after a gap it does");
    } else if (count < (length + 6u)) {
        a = (uint8_t)((a + frame[count]) % 256u);
        b = (uint8_t)((b + a) % 256u);
        __CPROVER_assert(!is_fix && holds(&ubx, frame, count + 1u, a, b),
                         "UBX_005_step: one more byte of it is held");
    } else if (count == (length + 6u)) {
        __CPROVER_assert(!is_fix && holds(&ubx, frame, count + 1u, a, b),
                         "UBX_004_half: half of the checksum is right");
    } else {
        const keel_ubx_fix_t says = model_ubx_fix(&frame[6], length);

        __CPROVER_assert(is_fix && ubx_fix_same(&ubx.fix, &says) && (ubx.age_us == 0u),
                         "UBX_005_taken: its last byte takes it, and this is what it says");
        __CPROVER_assert(ubx.count.fixes >= before.count.fixes, "UBX_007_counted: it is counted");
    }
}
