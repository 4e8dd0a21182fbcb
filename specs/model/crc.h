/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crc.h
 * @brief What the functions of keel/middleware/crc.h do.
 */
#ifndef MODEL_CRC_H
#define MODEL_CRC_H

#include "keel/middleware/crc.h"

uint8_t model_crc8(uint8_t crc, uint8_t byte);
uint16_t model_crc16(uint16_t crc, uint8_t byte);
uint32_t model_crc32(uint32_t crc, uint8_t byte);

#endif
