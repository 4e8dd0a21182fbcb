/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crc_contracts.h
 * @brief What keel_crc16 asks for and does, as far as a decoder needs to know: that it is a
 *        function of a checksum and a byte, the same as the model's (proofs/crc).
 */
#ifndef CRC_CONTRACTS_H
#define CRC_CONTRACTS_H

#include "../../specs/model/crc.h"

#include <stdbool.h>

static bool keel_crc16_may(uint16_t crc, uint8_t byte)
{
    return (crc <= 0xFFFFu) && (byte <= 0xFFu);
}

static bool keel_crc16_does(uint16_t is, uint16_t modelled)
{
    return is == modelled;
}

#endif
