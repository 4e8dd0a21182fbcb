// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/ubx.c
// checks: assertions
// covers: keel_ubx_take keel_ubx_pass_time
//
// The clause about the header of older receivers, without the model: any valid decoder, any byte,
// any time.
#include "ubx_proof.h"

/* ubx_shifted */
static uint64_t shifted_here(uint64_t window, uint8_t byte)
{
    return (window / 256u) + (0x10000000000u * (uint64_t)byte);
}

void keel_ubx_take__clauses_harness(void)
{
    keel_ubx_t ubx = any_ubx();
    const keel_ubx_t before = ubx;
    const uint8_t byte = nondet_u8();
    const uint32_t elapsed_us = nondet_u32();
    const bool ends = (before.step == 3u) && (byte == before.sum_b);
    const bool begins = !is_gap(&before, elapsed_us) && !ends &&
                        (shifted_here(before.window, byte) == 0x0054070162B5u);

    __CPROVER_assume(ubx_valid_here(&ubx));

    (void)keel_ubx_take(&ubx, byte, elapsed_us);

    __CPROVER_assert(!begins || ((ubx.step == 1u) && (ubx.kind == 1u) && (ubx.length == 84u) &&
                                 (ubx.left == 84u) && (ubx.sum_a == 0x5Cu) && (ubx.sum_b == 0xC1u)),
                     "UBX_010_header_14: a NAV-PVT of 84 bytes has begun");
}
