// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/middleware/crc.c specs/model/crc.c
// covers: keel_crc32 crc_rest model_crc32 all_bits
//
// Any rest and any byte.
#include "../../specs/model/crc.h"

#include <stdint.h>

uint8_t nondet_u8(void);
uint32_t nondet_u32(void);

void keel_crc32_harness(void)
{
    const uint32_t crc = nondet_u32();
    const uint8_t byte = nondet_u8();

    __CPROVER_assert(keel_crc32(crc, byte) == model_crc32(crc, byte),
                     "CRC_003_model: as the model says");
}
