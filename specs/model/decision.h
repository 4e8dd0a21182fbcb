/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file decision.h
 * @brief What the functions of keel/internal/rtos/decision.h do.
 */
#ifndef MODEL_DECISION_H
#define MODEL_DECISION_H

#include "keel/internal/rtos/decision.h"

uint32_t model_decision_realtime(const keel_queue_t *queue, uint32_t from, uint32_t to,
                                 uint64_t now_us);
uint64_t model_decision_earliest_us(const keel_queue_t *queue);
uint32_t model_decision_room_us(uint64_t earliest_us, uint64_t now_us, uint32_t guard_us);
keel_choice_t model_decision_other(const keel_queue_t *queue, uint64_t now_us, uint32_t room_us,
                                   bool without_promotion);
uint64_t model_decision_event_us(const keel_queue_t *queue, uint64_t now_us,
                                 bool without_promotion);

#endif
