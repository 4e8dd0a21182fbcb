/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file unknown_crc.h
 * @brief A checksum that is any function of the one before and a byte, the same for code and model.
 */
#ifndef UNKNOWN_CRC_H
#define UNKNOWN_CRC_H

#include "../common/crc_contracts.h"

uint16_t __CPROVER_uninterpreted_crc16(uint16_t crc, uint8_t byte);

uint16_t model_crc16(uint16_t crc, uint8_t byte)
{
    return __CPROVER_uninterpreted_crc16(crc, byte);
}

uint16_t keel_crc16_stand_in(uint16_t crc, uint8_t byte)
{
    const uint16_t is = __CPROVER_uninterpreted_crc16(crc, byte);

    __CPROVER_assert(keel_crc16_may(crc, byte), "precondition: keel_crc16");
    __CPROVER_assume(keel_crc16_does(is, model_crc16(crc, byte)));
    return is;
}

#endif
