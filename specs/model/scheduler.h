/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file scheduler.h
 * @brief What the functions of keel/rtos/scheduler.h do.
 */
#ifndef MODEL_SCHEDULER_H
#define MODEL_SCHEDULER_H

#include "keel/rtos/scheduler.h"

keel_status_t model_scheduler_init(keel_scheduler_t *scheduler,
                                   const keel_scheduler_config_t *config);
keel_status_t model_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted);
keel_status_t model_scheduler_add(keel_scheduler_t *scheduler, const keel_task_config_t *task);
keel_status_t model_scheduler_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task);
keel_status_t model_scheduler_start(keel_scheduler_t *scheduler);
keel_status_t model_scheduler_step(keel_scheduler_t *scheduler);
uint32_t model_scheduler_idle_us(const keel_scheduler_t *scheduler, uint32_t latency_us,
                                 uint32_t longest_us);
keel_status_t model_scheduler_resync(keel_scheduler_t *scheduler);
const keel_task_config_t *model_scheduler_task(const keel_scheduler_t *scheduler,
                                               uint32_t position);
keel_status_t model_scheduler_report(const keel_scheduler_t *scheduler,
                                     const keel_task_config_t *task, keel_task_report_t *report);

#endif
