/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sbus.h
 * @brief What the functions of keel/middleware/sbus.h do.
 */
#ifndef MODEL_SBUS_H
#define MODEL_SBUS_H

#include "keel/middleware/sbus.h"

keel_status_t model_sbus_init(keel_sbus_t *sbus, const keel_sbus_config_t *config);
bool model_sbus_take(keel_sbus_t *sbus, uint8_t byte, uint32_t elapsed_us);
void model_sbus_pass_time(keel_sbus_t *sbus, uint32_t elapsed_us);
uint16_t model_sbus_us(uint16_t raw);

/* The bits of a channel in the 25 bytes of a frame (RAD-005), and whether they are right (RAD-004):
 * what the proofs say frames by. */
uint16_t model_sbus_channel(const uint8_t *frame, uint32_t index);
bool model_sbus_right(const uint8_t *frame, const keel_sbus_config_t *config);

#endif
