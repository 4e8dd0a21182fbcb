/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file framing.h
 * @brief What the functions of keel/middleware/framing.h do.
 */
#ifndef MODEL_FRAMING_H
#define MODEL_FRAMING_H

#include "keel/internal/middleware/framing.h"

#include <stdbool.h>

uint32_t model_framing_sum(uint32_t a, uint32_t b);
void model_framing_begin(keel_framing_t *framing, uint32_t gap_us, const uint8_t *header);
bool model_framing_header(const keel_framing_t *framing, uint8_t byte);
void model_framing_pass_time(keel_framing_t *framing, uint32_t elapsed_us);
void model_framing_take(keel_framing_t *framing, uint8_t byte, uint32_t elapsed_us);
void model_framing_drop(keel_framing_t *framing, uint32_t count);

#endif
