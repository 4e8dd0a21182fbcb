/**
 * @file urpilot_tasks.h
 * @brief The 21 tasks of the paper's flight controller (table 2), as data.
 */
#ifndef URPILOT_TASKS_H
#define URPILOT_TASKS_H

#include <stdint.h>

#define URPILOT_TASK_COUNT 21u

/** One row of table 2. */
typedef struct urpilot_task {
    const char *name;
    uint32_t priority;  /**< One of KEEL_PRIORITY_*. */
    uint32_t period_us; /**< Period, in us. */
    uint32_t wcet_us;   /**< Worst-case execution time, in us. */
} urpilot_task_t;

/** Table 2, in its order. */
extern const urpilot_task_t urpilot_task[URPILOT_TASK_COUNT];

#endif
