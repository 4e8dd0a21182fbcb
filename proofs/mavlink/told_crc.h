/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file told_crc.h
 * @brief A checksum that is any function of the one before and a byte. The model is told any
 *        numbers, which are drawn before; the code must ask the same, byte by byte, and is told the
 *        same. Of how many bytes, that of the message included, whoever includes this says: ASKED.
 */
#ifndef TOLD_CRC_H
#define TOLD_CRC_H

#include "../common/crc_contracts.h"

/* What is told, drawn at once. */
typedef struct {
    uint16_t crc[ASKED];
} told_t;

told_t nondet_told(void);

static uint8_t asked[ASKED];
static told_t told;
static uint32_t asks;
static bool is_model;

static uint16_t crc_told(uint16_t crc, uint8_t byte)
{
    const uint32_t n = asks;

    __CPROVER_assert(n < ASKED, "MAV_004_asks: no more than a frame has");
    __CPROVER_assert(crc == ((n == 0u) ? 0xFFFFu : told.crc[n - 1u]), "MAV_004_order: in turn");
    asks = n + 1u;
    if (is_model) {
        asked[n] = byte;
    } else {
        __CPROVER_assert(byte == asked[n], "MAV_004_same: of the same byte");
    }
    return told.crc[n];
}

static void tell_model(void)
{
    told = nondet_told();
    asks = 0u;
    is_model = true;
}

static void tell_code(void)
{
    asks = 0u;
    is_model = false;
}

uint16_t model_crc16(uint16_t crc, uint8_t byte)
{
    return crc_told(crc, byte);
}

uint16_t keel_crc16_stand_in(uint16_t crc, uint8_t byte)
{
    const uint16_t modelled = model_crc16(crc, byte);
    const uint16_t is = modelled; /* Not drawn anew: executions find no such number. */

    __CPROVER_assert(keel_crc16_may(crc, byte), "precondition: keel_crc16");
    __CPROVER_assume(keel_crc16_does(is, modelled));
    return is;
}

#endif
