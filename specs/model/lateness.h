/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file lateness.h
 * @brief What the function of keel/rtos/lateness.h does.
 */
#ifndef MODEL_LATENESS_H
#define MODEL_LATENESS_H

#include "keel/rtos/lateness.h"

keel_status_t model_scheduler_lateness(const keel_scheduler_t *scheduler,
                                       const keel_task_config_t *task, keel_lateness_t *lateness);

#endif
