/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pass.h
 * @brief What the functions of keel/internal/rtos/pass.h do.
 */
#ifndef MODEL_PASS_H
#define MODEL_PASS_H

#include "keel/internal/rtos/pass.h"

keel_status_t model_pass_begin(keel_scheduler_t *scheduler, uint32_t raw_us);
const keel_task_config_t *model_pass_next(keel_scheduler_t *scheduler);
keel_status_t model_pass_finish(keel_scheduler_t *scheduler, uint32_t raw_us);
keel_status_t model_pass_turn(keel_scheduler_t *scheduler);
keel_status_t model_pass_run(keel_scheduler_t *scheduler);
uint32_t model_pass_idle_us(const keel_scheduler_t *scheduler, uint32_t raw_us, uint32_t latency_us,
                            uint32_t longest_us);

#endif
