/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file crsf.h
 * @brief What the functions of keel/middleware/crsf.h do.
 */
#ifndef MODEL_CRSF_H
#define MODEL_CRSF_H

#include "keel/middleware/crsf.h"

keel_status_t model_crsf_init(keel_crsf_t *crsf, const keel_crsf_config_t *config);
keel_crsf_taken_t model_crsf_take(keel_crsf_t *crsf, uint8_t byte, uint32_t elapsed_us);
void model_crsf_pass_time(keel_crsf_t *crsf, uint32_t elapsed_us);
bool model_crsf_is_lost(const keel_crsf_t *crsf);
uint8_t model_crsf_crc(const uint8_t *bytes, uint32_t count);

/* A channel of a frame (CRF-005), and whether the bytes of one are right (CRF-004): what the proofs
 * say frames by. */
uint16_t model_crsf_channel(const uint8_t *frame, uint32_t index);
bool model_crsf_right(const uint8_t *frame);

#endif
