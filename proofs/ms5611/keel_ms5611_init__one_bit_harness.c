// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 121 --external-sat-solver cadical
// sources: src/middleware/ms5611.c specs/model/ms5611.c
// covers: keel_ms5611_init keel_ms5611_crc nibble_of nibble_rest is_blank
//
// Any PROM that is taken, and any one bit of it that is checked: with that bit wrong it is refused.
#include "../common/unchanged.h"
#include "ms5611_proof.h"

void keel_ms5611_init__one_bit_harness(void)
{
    uint16_t word[KEEL_MS5611_WORDS];
    keel_ms5611_t ms5611 = any_ms5611();
    keel_ms5611_t before;
    const uint32_t bit = nondet_u32();
    bool taken;

    any_words(word);
    taken = model_ms5611_crc(word) == (word[7] % 16u);
    __CPROVER_assume((bit < 128u) && ((bit < 120u) || (bit >= 124u)));
    word[bit / 16u] = (uint16_t)(word[bit / 16u] ^ (1u << (15u - (bit % 16u))));
    before = ms5611;

    if (keel_ms5611_init(&ms5611, word) != KEEL_OK) {
        __CPROVER_assert(unchanged(&ms5611, &before, sizeof(ms5611)),
                         "STA_001_kept: a refusal changes nothing");
    } else {
        __CPROVER_assert(!taken, "MSC_002_one_bit: one wrong bit is noticed");
    }
}
