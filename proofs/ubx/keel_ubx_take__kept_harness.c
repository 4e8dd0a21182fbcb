// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ubx.c specs/model/ubx.c
// covers: keel_ubx_take keel_ubx_pass_time
//
// Each clause of the contract, without the model: what is published was right as a whole, nothing
// else is, and what is counted and timed.
#include "ubx_proof.h"

/* ubx_sum */
static uint32_t sum_here(uint32_t a, uint32_t b)
{
    const uint64_t sum = (uint64_t)a + b;

    return (sum > UINT32_MAX) ? UINT32_MAX : (uint32_t)sum;
}

/* ubx_advances */
static bool advances_here(uint32_t from, uint32_t to)
{
    const uint32_t week = 604800000u;

    return (from < week) && (to < week) &&
           ((from < to) ? ((to - from) < (week / 2u)) : ((from - to) > (week / 2u)));
}

/* What a fix that was taken says, and what one byte that takes none leaves as it was. */
static void check_fix(const keel_ubx_t *u, const keel_ubx_t *before, uint8_t byte, bool is_fix,
                      bool gap)
{
    if (is_fix) {
        __CPROVER_assert((before->step == 3u) && (before->kind == 1u) && (byte == before->sum_b) &&
                             !gap,
                         "UBX_004_last: this byte ends a right NAV-PVT");
        __CPROVER_assert(ubx_fix_same(&u->fix, &before->pending), "UBX_005_says: what came of it");
        __CPROVER_assert((u->age_us == 0u) && (u->step == 0u) && (u->window == 0u),
                         "UBX_008_new: it is new, and nothing of it is part of another one");
        __CPROVER_assert(u->is_advancing ==
                             ((before->count.fixes > 0u) &&
                              advances_here(before->fix.tow_ms, before->pending.tow_ms)),
                         "UBX_012_advancing: whether its time is after that of the one before");
    } else {
        __CPROVER_assert(ubx_fix_same(&u->fix, &before->fix) &&
                             (u->is_advancing == before->is_advancing),
                         "UBX_006_kept: without a right one the last one stays");
    }
    __CPROVER_assert((u->step != 3u) || ((before->step == 2u) && (byte == before->sum_a)),
                     "UBX_004_first: half of the checksum was right");
}

/* What is under way. */
static void check_search(const keel_ubx_t *u, const keel_ubx_t *before, uint8_t byte, bool is_fix,
                         bool gap)
{
    const uint64_t latest = (uint64_t)byte * 0x10000000000u;
    const uint64_t window = (before->window / 256u) + latest;
    const bool begins_14 = window == 0x0054070162B5u;
    const bool begins = (window == 0x005C070162B5u) || begins_14;
    const uint64_t length = window >> 32;

    if (gap) {
        __CPROVER_assert(!is_fix && (u->step == 0u) && (u->window == latest),
                         "UBX_009_gap: silence ended what was under way");
    } else if (begins && ((before->step != 3u) || (byte != before->sum_b))) {
        __CPROVER_assert((u->step == 1u) && (u->kind == 1u) && (u->length == length) &&
                             (u->left == length) && (u->sum_a == (begins_14 ? 0x5Cu : 0x64u)) &&
                             (u->sum_b == (begins_14 ? 0xC1u : 0xD1u)),
                         "UBX_010_header: a NAV-PVT has begun");
    } else if (!begins && (before->step == 1u)) {
        __CPROVER_assert((u->left == (before->left - 1u)) && (u->length == before->length) &&
                             (u->step == ((u->left > 0u) ? 1u : 2u)),
                         "UBX_011_skipped: one byte of the payload less is to come");
    } else if ((before->step == 0u) && ((window & 0xFFFFFFFFu) == 0x070162B5u)) {
        __CPROVER_assert(
            (u->kind == 1u) == (length >= 84u),
            "UBX_016_kind: of at least 84 bytes it is a NAV-PVT, else another message");
        __CPROVER_assert((u->step == ((length > 0u) ? 1u : 2u)) && (u->length == length) &&
                             (u->left == length),
                         "UBX_016_begins: one of any length has begun");
    }
}

void keel_ubx_take__kept_harness(void)
{
    keel_ubx_t ubx = any_ubx();
    const keel_ubx_t before = ubx;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    const bool gap = is_gap(&before, elapsed_us);
    bool is_fix;

    __CPROVER_assume(ubx_valid_here(&ubx));

    is_fix = keel_ubx_take(&ubx, byte, elapsed_us);

    __CPROVER_assert(ubx_valid_here(&ubx), "UBX_003_valid: it stays valid");
    __CPROVER_assert(ubx_config_same(&ubx.config, &before.config),
                     "UBX_006_config: the configuration stays");
    check_fix(&ubx, &before, byte, is_fix, gap);
    check_search(&ubx, &before, byte, is_fix, gap);
    __CPROVER_assert(ubx.count.fixes == sum_here(before.count.fixes, is_fix ? 1u : 0u),
                     "UBX_007_fixes: each is counted, and nothing else as one");
    __CPROVER_assert(ubx.count.bytes == sum_here(before.count.bytes, 1u),
                     "UBX_007_bytes: each byte is counted");
    __CPROVER_assert(ubx.age_us == (is_fix ? 0u : sum_here(before.age_us, elapsed_us)),
                     "UBX_008_age: how old the last one is");
    __CPROVER_assert(ubx.quiet_us == 0u, "UBX_008_quiet: silence ended");
}
