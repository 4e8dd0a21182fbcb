/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/task.h
 * @brief The contracts of task.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_TASK_H
#define KEEL_INTERNAL_RTOS_TASK_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/priority.h"
#include "keel/rtos/task.h"

KEEL_C_BEGIN

/*@ predicate config_valid(keel_task_config_t *config) =
  @     config->run != \null && period_valid(config->period_us) && 0 < config->budget_us &&
  @     config->phase_us < config->period_us && priority_valid(config->priority);
  @
  @ // A declaration that has a body is refused for the first of these that applies.
  @ predicate config_refused(keel_task_config_t *config, integer status) =
  @     (status == KEEL_ERR_PERIOD && !period_valid(config->period_us)) ||
  @     (status == KEEL_ERR_PHASE && period_valid(config->period_us) &&
  @      config->phase_us >= config->period_us) ||
  @     (status == KEEL_ERR_BUDGET_ZERO && period_valid(config->period_us) &&
  @      config->phase_us < config->period_us && config->budget_us == 0) ||
  @     (status == KEEL_ERR_PRIORITY && period_valid(config->period_us) &&
  @      config->phase_us < config->period_us && config->budget_us > 0 &&
  @      !priority_valid(config->priority));
  @*/

/*@ requires config == \null || \valid_read(config);
  @ assigns \nothing;
  @ behavior null:
  @   assumes config == \null || config->run == \null;
  @   ensures TSK_002_null: \result == KEEL_ERR_NULL;
  @ behavior period:
  @   assumes config != \null && config->run != \null;
  @   assumes !period_valid(config->period_us);
  @   ensures TSK_002_period: \result == KEEL_ERR_PERIOD;
  @ behavior phase:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us >= config->period_us;
  @   ensures TSK_002_phase: \result == KEEL_ERR_PHASE;
  @ behavior budget:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us < config->period_us;
  @   assumes config->budget_us == 0;
  @   ensures TSK_002_budget: \result == KEEL_ERR_BUDGET_ZERO;
  @ behavior priority:
  @   assumes config != \null && config->run != \null;
  @   assumes period_valid(config->period_us) && config->phase_us < config->period_us;
  @   assumes config->budget_us > 0 && !priority_valid(config->priority);
  @   ensures TSK_002_priority: \result == KEEL_ERR_PRIORITY;
  @ behavior valid:
  @   assumes config != \null && config_valid(config);
  @   ensures TSK_002_valid: \result == KEEL_OK;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_task_check(const keel_task_config_t *config);

KEEL_C_END

#endif
