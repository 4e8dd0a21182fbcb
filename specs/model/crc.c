/* SPDX-License-Identifier: Apache-2.0 */
/* A circuit of one bit at a time: the bit that leaves the register, and the one that comes, tell
 * whether the polynomial is taken off. The byte's bits come one by one; nothing is in before. */
#include "crc.h"

/* CRC-001. The highest bit first. */
uint8_t model_crc8(uint8_t crc, uint8_t byte)
{
    uint8_t shifted = crc;

    for (int bit = 7; bit >= 0; bit--) {
        const int comes = (byte >> bit) & 1;
        const int leaves = (shifted >> 7) & 1;

        shifted = (uint8_t)((shifted << 1) & 0xFF);
        if (comes != leaves) {
            shifted = (uint8_t)(shifted ^ 0xD5);
        }
    }
    return shifted;
}

/* CRC-002, CRC-003. The lowest bit first. */
static uint32_t all_bits(uint32_t crc, uint8_t byte, uint32_t polynomial)
{
    uint32_t shifted = crc;

    for (uint32_t bit = 0u; bit < 8u; bit++) {
        const uint32_t comes = ((uint32_t)byte >> bit) & 1u;
        const uint32_t leaves = shifted & 1u;

        shifted = shifted >> 1;
        if (comes != leaves) {
            shifted = shifted ^ polynomial;
        }
    }
    return shifted;
}

uint16_t model_crc16(uint16_t crc, uint8_t byte)
{
    return (uint16_t)all_bits(crc, byte, 0x8408u);
}

uint32_t model_crc32(uint32_t crc, uint8_t byte)
{
    return all_bits(crc, byte, 0xEDB88320u);
}
