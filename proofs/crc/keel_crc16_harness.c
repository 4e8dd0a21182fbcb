// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 9 --external-sat-solver cadical
// sources: src/middleware/crc.c specs/model/crc.c
// covers: keel_crc16 crc_rest model_crc16 all_bits
//
// Any rest and any byte.
#include "../common/crc_contracts.h"

#include <stdint.h>

uint8_t nondet_u8(void);
uint16_t nondet_u16(void);

void keel_crc16_harness(void)
{
    const uint16_t crc = nondet_u16();
    const uint8_t byte = nondet_u8();
    const uint16_t expected = model_crc16(crc, byte);
    uint16_t is;

    __CPROVER_assume(keel_crc16_may(crc, byte));
    is = keel_crc16(crc, byte);

    __CPROVER_assert(keel_crc16_does(is, expected), "CRC_002_model: as the model says");
}
