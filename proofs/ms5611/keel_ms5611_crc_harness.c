// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 121 --external-sat-solver cadical
// sources: src/middleware/ms5611.c specs/model/ms5611.c
// covers: keel_ms5611_crc nibble_of nibble_rest model_ms5611_crc
//
// Any PROM.
#include "ms5611_proof.h"

void keel_ms5611_crc_harness(void)
{
    uint16_t word[KEEL_MS5611_WORDS];
    uint8_t crc;

    any_words(word);

    crc = keel_ms5611_crc(word);

    __CPROVER_assert(crc == model_ms5611_crc(word), "MSC_001_model: the rest is what it is");
    __CPROVER_assert(crc < 16u, "MSC_001_four: it has four bits");
}
