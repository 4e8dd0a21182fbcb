/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file queue.h
 * @brief What the functions of keel/rtos/queue.h do.
 */
#ifndef MODEL_QUEUE_H
#define MODEL_QUEUE_H

#include "keel/internal/rtos/queue.h"

void model_queue_init(keel_queue_t *queue);
uint32_t model_queue_find(const keel_queue_t *queue, const keel_task_config_t *task);
void model_queue_add(keel_queue_t *queue, const keel_task_config_t *task, uint64_t release_us);
void model_queue_remove(keel_queue_t *queue, uint32_t position);
void model_queue_advance(keel_queue_t *queue, uint32_t slot, uint64_t now_us);

#endif
