/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/crc.h
 * @brief The contracts of crc.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_CRC_H
#define KEEL_INTERNAL_MIDDLEWARE_CRC_H

#include "keel/c_declarations.h"
#include "keel/middleware/crc.h"

KEEL_C_BEGIN

/*@ // The rest after so many bits, the highest first, that are in it already.
  @ logic integer crc_up(integer rest, integer bits) =
  @     bits <= 0 ? rest :
  @     \let before = crc_up(rest, bits - 1);
  @     \let shifted = (before % 128) << 1;
  @         (before & 128) != 0 ? shifted ^ KEEL_CRC8_POLYNOMIAL : shifted;
  @
  @ // The rest after so many bits, the lowest first, that are in it already.
  @ logic integer crc_down(integer rest, integer polynomial, integer bits) =
  @     bits <= 0 ? rest :
  @     \let before = crc_down(rest, polynomial, bits - 1);
  @         (before & 1) != 0 ? (before >> 1) ^ polynomial : before >> 1;
  @*/

/*@ assigns \nothing;
  @ ensures CRC_001: \result == (crc_up(crc ^ byte, 8) & 0xFF);
  @*/
uint8_t keel_crc8(uint8_t crc, uint8_t byte);

/*@ assigns \nothing;
  @ ensures CRC_002: \result == (crc_down(crc ^ byte, KEEL_CRC16_POLYNOMIAL, 8) & 0xFFFF);
  @*/
uint16_t keel_crc16(uint16_t crc, uint8_t byte);

/*@ assigns \nothing;
  @ ensures CRC_003: \result == crc_down(crc ^ byte, KEEL_CRC32_POLYNOMIAL, 8);
  @*/
uint32_t keel_crc32(uint32_t crc, uint8_t byte);

KEEL_C_END

#endif
