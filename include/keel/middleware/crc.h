/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crc.h
 * @brief Cyclic redundancy checks, a byte at a time: what came over a link, or out of a memory, is
 *        what was sent.
 *
 * A check is the rest of the bytes, as a polynomial over two values, divided by the check's
 * polynomial. Each function takes the rest so far and the next byte. Rest and polynomial below are
 * in the order in which the bits are sent: keel_crc8 begins with a byte's highest bit, the others
 * with its lowest.
 *
 * They are proved equal to specs/model/crc.c, a circuit of one bit at a time, for every rest and
 * byte. They use no table, so that a check costs eight shifts a byte and no flash.
 */
#ifndef KEEL_MIDDLEWARE_CRC_H
#define KEEL_MIDDLEWARE_CRC_H

#include "keel/c_declarations.h"

#include <stdint.h>

KEEL_C_BEGIN

/** x^8 + x^7 + x^6 + x^4 + x^2 + 1, the highest power first and left out. */
#define KEEL_CRC8_POLYNOMIAL 0xD5u

/** The first remainder of keel_crc8. */
#define KEEL_CRC8_FIRST 0u

/** x^16 + x^12 + x^5 + 1, the lowest power first. */
#define KEEL_CRC16_POLYNOMIAL 0x8408u

/** The first remainder of keel_crc16. */
#define KEEL_CRC16_FIRST 0xFFFFu

/** IEEE 802.3's polynomial of degree 32, the lowest power first. */
#define KEEL_CRC32_POLYNOMIAL 0xEDB88320u

/** The first remainder of keel_crc32. */
#define KEEL_CRC32_FIRST 0xFFFFFFFFu

/**
 * Takes a byte into CRC-8/DVB-S2, which CRSF uses (requirement CRC-001).
 *
 * @param crc  of the bytes before; KEEL_CRC8_FIRST before the first
 * @param byte the next
 * @return of all of them; followed by it, the rest is 0
 */
uint8_t keel_crc8(uint8_t crc, uint8_t byte);

/**
 * Takes a byte into CRC-16/MCRF4XX, which MAVLink uses (requirement CRC-002).
 *
 * @param crc  of the bytes before; KEEL_CRC16_FIRST before the first
 * @param byte the next
 * @return of all of them
 */
uint16_t keel_crc16(uint16_t crc, uint8_t byte);

/**
 * Takes a byte into CRC-32/ISO-HDLC (requirement CRC-003).
 *
 * @param crc  of the bytes before; KEEL_CRC32_FIRST before the first
 * @param byte the next
 * @return of all of them; what is sent or stored is its complement
 */
uint32_t keel_crc32(uint32_t crc, uint8_t byte);

KEEL_C_END

#endif
