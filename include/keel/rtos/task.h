/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file task.h
 * @brief A task, as its programmer declares it.
 *
 * The paper's task model: every task is periodic, its deadline is the end of its period, and
 * nothing preempts it. The declaration is a constant that can live in flash, so that a table of
 * tasks is data that an analyser can read. Its address is the task's handle.
 */
#ifndef KEEL_RTOS_TASK_H
#define KEEL_RTOS_TASK_H

#include "keel/c_declarations.h"
#include "keel/rtos/priority.h"
#include "keel/status.h"

#include <stddef.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The body of a task: runs once per release, to its end. */
typedef void (*keel_task_fn_t)(void *context);

/**
 * A task, as its programmer declares it. Adding it copies the fields that scheduling reads;
 * name, body and context are read while it is in the queue, and must not change meanwhile.
 */
typedef struct keel_task_config {
    const char *name;   /**< For reports; may be null. */
    keel_task_fn_t run; /**< The body. */
    void *context;      /**< Handed to the body; may be null. */
    uint32_t period_us; /**< Period T and relative deadline, 1 to 2^31 - 1 us. */
    uint32_t budget_us; /**< Declared worst-case execution time, at least 1 us. */
    uint32_t phase_us;  /**< First release after the start, less than a period, in us. */
    uint32_t priority;  /**< KEEL_PRIORITY_LOW to KEEL_PRIORITY_HIGH, or KEEL_PRIORITY_REALTIME. */
} keel_task_config_t;

/**
 * Checks a declaration by itself, before it meets others (requirement TSK-002).
 *
 * @param config the declaration, or null
 * @return KEEL_OK, or the first that applies of KEEL_ERR_NULL (also for a null body),
 *         KEEL_ERR_PERIOD, KEEL_ERR_PHASE, KEEL_ERR_BUDGET_ZERO, KEEL_ERR_PRIORITY
 */
keel_status_t keel_task_check(const keel_task_config_t *config);

KEEL_C_END

#endif
