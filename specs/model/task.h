/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file task.h
 * @brief What the function of keel/rtos/task.h does.
 */
#ifndef MODEL_TASK_H
#define MODEL_TASK_H

#include "keel/rtos/task.h"

keel_status_t model_task_check(const keel_task_config_t *config);

#endif
