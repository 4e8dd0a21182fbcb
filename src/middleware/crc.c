/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/crc.h"

#define BITS  8u
#define TOP   0x80u
#define LEAST 1u

/* The width to which a remainder is cut: nothing is lost, but the provers need not see that. */
#define BYTE 0xFFu
#define WORD 0xFFFFu

uint8_t keel_crc8(uint8_t crc, uint8_t byte)
{
    uint32_t rest = (uint32_t)crc ^ byte;

    /*@ loop invariant 0 <= i <= BITS;
      @ loop invariant rest == crc_up(crc ^ byte, i);
      @ loop assigns i, rest;
      @ loop variant BITS - i;
      @*/
    for (uint32_t i = 0u; i < BITS; i++) {
        const uint32_t shifted = (rest % TOP) << 1u;

        rest = ((rest & TOP) != 0u) ? (shifted ^ KEEL_CRC8_POLYNOMIAL) : shifted;
    }
    return (uint8_t)(rest & BYTE);
}

/* Divides eight bits, the lowest first. */
/*@ assigns \nothing;
  @ ensures \result == crc_down(dividend, polynomial, BITS);
  @*/
static uint32_t crc_rest(uint32_t dividend, uint32_t polynomial)
{
    uint32_t rest = dividend;

    /*@ loop invariant 0 <= i <= BITS;
      @ loop invariant rest == crc_down(dividend, polynomial, i);
      @ loop assigns i, rest;
      @ loop variant BITS - i;
      @*/
    for (uint32_t i = 0u; i < BITS; i++) {
        rest = ((rest & LEAST) != 0u) ? ((rest >> 1u) ^ polynomial) : (rest >> 1u);
    }
    return rest;
}

uint16_t keel_crc16(uint16_t crc, uint8_t byte)
{
    return (uint16_t)(crc_rest((uint32_t)crc ^ byte, KEEL_CRC16_POLYNOMIAL) & WORD);
}

uint32_t keel_crc32(uint32_t crc, uint8_t byte)
{
    return crc_rest(crc ^ byte, KEEL_CRC32_POLYNOMIAL);
}
