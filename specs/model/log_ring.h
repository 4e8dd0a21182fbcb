/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file log_ring.h
 * @brief What the functions of keel/middleware/log_ring.h do: on an array that shifts, which lies
 *        in the ring from its tail on.
 */
#ifndef MODEL_LOG_RING_H
#define MODEL_LOG_RING_H

#include "keel/middleware/log_ring.h"

void model_log_ring_init(keel_log_ring_t *ring);
uint32_t model_log_ring_held(const keel_log_ring_t *ring);
bool model_log_ring_write(keel_log_ring_t *ring, const uint8_t *record, uint32_t size,
                          uint64_t now_us);
bool model_log_ring_take_loss(keel_log_ring_t *ring, uint32_t size, keel_log_ring_loss_t *loss);
uint32_t model_log_ring_read(keel_log_ring_t *ring, uint8_t *to, uint32_t most);

#endif
