/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file ibus.h
 * @brief What the functions of keel/middleware/ibus.h do.
 */
#ifndef MODEL_IBUS_H
#define MODEL_IBUS_H

#include "keel/middleware/ibus.h"

keel_status_t model_ibus_init(keel_ibus_t *ibus, const keel_ibus_config_t *config);
bool model_ibus_take(keel_ibus_t *ibus, uint8_t byte, uint32_t elapsed_us);
void model_ibus_pass_time(keel_ibus_t *ibus, uint32_t elapsed_us);

/* A channel of a frame (IBU-005), and whether the bytes of one are right (IBU-004): what the proofs
 * say frames by. */
uint16_t model_ibus_channel(const uint8_t *frame, uint32_t index, bool extended);
bool model_ibus_right(const uint8_t *frame, const keel_ibus_config_t *config);

#endif
