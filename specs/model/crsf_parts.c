/* SPDX-License-Identifier: Apache-2.0 */
/* What a frame's CRC is: apart, as the proofs of the decoder hold for any. */
#include "crc.h"
#include "crsf.h"

/* CRF-013 */
uint8_t model_crsf_crc(const uint8_t *bytes, uint32_t count)
{
    uint8_t crc = 0u;

    for (uint32_t i = 0u; i < 62u; i++) {
        if (i < count) {
            crc = model_crc8(crc, bytes[i]);
        }
    }
    return crc;
}
