// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/middleware/crc.c specs/model/crc.c
// covers: keel_crc8 model_crc8
//
// Any rest and any byte.
#include "../../specs/model/crc.h"

#include <stdint.h>

uint8_t nondet_u8(void);

void keel_crc8_harness(void)
{
    const uint8_t crc = nondet_u8();
    const uint8_t byte = nondet_u8();

    __CPROVER_assert(keel_crc8(crc, byte) == model_crc8(crc, byte),
                     "CRC_001_model: as the model says");
}
