/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file queue.h
 * @brief The one task queue that both halves of the scheduler share: no gaps, nothing outside.
 *
 * A queue holds its tasks itself. A slot has the data of a task, by field, and a slot
 * never moves; the queue proper is an order of slots, one byte each: those in use in queue order,
 * then the free ones. So a task is put in its place, or taken out, by moving a few bytes, there is
 * always a free slot to take, and no pointer leads from one task to another.
 *
 * In the order the real-time tasks come first, then the others, each class as its tasks were added:
 * order matters only within a class (FCFS serves real-time tasks in queue order, EDF breaks ties by
 * it), and with the classes apart neither half of the scheduler looks at the tasks of the other.
 *
 * An application calls keel_scheduler_add and keel_scheduler_remove; the queue's own functions are
 * the kernel's.
 */
#ifndef KEEL_RTOS_QUEUE_H
#define KEEL_RTOS_QUEUE_H

#include "keel/c_declarations.h"
#include "keel/rtos/clock.h"
#include "keel/rtos/priority.h"
#include "keel/rtos/stats.h"
#include "keel/rtos/task.h"

#include <stdint.h>

KEEL_C_BEGIN

/** How many tasks a queue holds: 1 to 255. The proofs are for 32. */
#ifndef KEEL_QUEUE_CAPACITY
#define KEEL_QUEUE_CAPACITY 32u
#endif

#if KEEL_QUEUE_CAPACITY > 255u
#error "KEEL_QUEUE_CAPACITY: a slot's number must fit into a byte"
#endif

/**
 * The queue. Its caller owns the memory; only the functions of the kernel write it.
 *
 * Types tell who writes what: what adding and removing alone change is of 8 bits, what deciding
 * changes is not. Provers know memory by its type, and need no further reason.
 */
typedef struct keel_queue {
    uint8_t count;                            /**< Tasks in the queue. */
    uint8_t realtime_count;                   /**< How many of them, at the front, are real-time. */
    uint8_t order[KEEL_QUEUE_CAPACITY];       /**< All slots: in queue order, then free ones. */
    uint8_t priority[KEEL_QUEUE_CAPACITY];    /**< By slot: the static priority. */
    uint16_t skipped[KEEL_QUEUE_CAPACITY];    /**< Whole periods passed unserved; saturates. */
    uint32_t period_us[KEEL_QUEUE_CAPACITY];  /**< The period T, in us. */
    uint32_t budget_us[KEEL_QUEUE_CAPACITY];  /**< The declared worst-case execution time, in us. */
    uint64_t release_us[KEEL_QUEUE_CAPACITY]; /**< The next release to serve, in us. */
    keel_stats_t stats[KEEL_QUEUE_CAPACITY];  /**< How its runs went. */
    const keel_task_config_t *task[KEEL_QUEUE_CAPACITY]; /**< Its declaration; null: free. */
} keel_queue_t;

KEEL_C_END

#endif
