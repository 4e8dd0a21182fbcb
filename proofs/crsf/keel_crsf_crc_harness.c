// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 63 --external-sat-solver cadical
// sources: src/middleware/crsf.c src/middleware/framing.c src/middleware/crc.c
// sources: specs/model/crsf_parts.c specs/model/crc.c
// covers: keel_crsf_crc model_crsf_crc
//
// Up to 4 bytes, any of them. For any number, WP proves what it is (CRF_013_crc).
#define CRC_AS_IT_IS
#include "crsf_proof.h"

void keel_crsf_crc_harness(void)
{
    uint8_t bytes[62];
    const uint32_t count = nondet_u32();
    uint8_t expected;
    uint8_t crc;

    for (uint32_t i = 0u; i < 62u; i++) {
        bytes[i] = nondet_u8();
    }
    __CPROVER_assume(keel_crsf_crc_may(bytes, count) && (count <= 4u));
    expected = model_crsf_crc(bytes, count);

    crc = keel_crsf_crc(bytes, count);

    __CPROVER_assert(crc == expected, "CRF_013_model: as the model says");
    __CPROVER_assert(keel_crsf_crc_does(crc, count), "CRF_013_begins: of no bytes it is 0");
}
