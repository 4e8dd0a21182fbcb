/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ubx.h
 * @brief What the functions of keel/middleware/ubx.h do.
 */
#ifndef MODEL_UBX_H
#define MODEL_UBX_H

#include "keel/middleware/ubx.h"

keel_status_t model_ubx_init(keel_ubx_t *ubx, const keel_ubx_config_t *config);
bool model_ubx_take(keel_ubx_t *ubx, uint8_t byte, uint32_t elapsed_us);
void model_ubx_pass_time(keel_ubx_t *ubx, uint32_t elapsed_us);
keel_ubx_verdict_t model_ubx_judge(const keel_ubx_t *ubx);
keel_status_t model_ubx_write_value(keel_ubx_message_t *message, uint32_t key, uint32_t value);
void model_ubx_write_output(keel_ubx_message_t *message, uint8_t group, uint8_t id, uint8_t every);
void model_ubx_write_rate(keel_ubx_message_t *message, uint16_t period_ms);
void model_ubx_write_port(keel_ubx_message_t *message, uint32_t baud);

/* What a NAV-PVT says, from its payload of at least 84 bytes (UBX-005, UBX-016). */
keel_ubx_fix_t model_ubx_fix(const uint8_t *payload, uint32_t length);

#endif
