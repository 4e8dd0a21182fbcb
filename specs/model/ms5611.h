/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ms5611.h
 * @brief What the functions of keel/middleware/ms5611.h do.
 */
#ifndef MODEL_MS5611_H
#define MODEL_MS5611_H

#include "keel/middleware/ms5611.h"

uint8_t model_ms5611_crc(const uint16_t *word);
keel_status_t model_ms5611_init(keel_ms5611_t *ms5611, const uint16_t *word);
keel_status_t model_ms5611_compensate(const keel_ms5611_t *ms5611, uint32_t d1, uint32_t d2,
                                      keel_ms5611_sample_t *sample);

#endif
