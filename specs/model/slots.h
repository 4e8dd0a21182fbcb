/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file slots.h
 * @brief What the functions of keel/middleware/slots.h do.
 */
#ifndef MODEL_SLOTS_H
#define MODEL_SLOTS_H

#include "keel/middleware/slots.h"

keel_status_t model_slots_init(keel_slots_t *slots, const keel_slots_config_t *config);
keel_slots_result_t model_slots_load(keel_slots_t *slots, uint8_t *image, uint32_t *length);
keel_status_t model_slots_begin(keel_slots_t *slots, const uint8_t *image, uint32_t length);
keel_slots_result_t model_slots_step(keel_slots_t *slots);

/* A byte of a slot that holds this set (SLT-010): what the proofs say slots by. */
uint8_t model_slots_byte(uint32_t sequence, const uint8_t *image, uint32_t length, uint32_t at);

/* Whether these bytes of a slot are a set that is whole (SLT-003), of at most so many bytes. */
bool model_slots_whole(const uint8_t *slot, uint32_t room);

#endif
