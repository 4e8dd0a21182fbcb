/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file supervisor.h
 * @brief Whether the scheduler meets its real-time releases: only then is the watchdog fed.
 */
#ifndef KEEL_BSP_COMMON_SUPERVISOR_H
#define KEEL_BSP_COMMON_SUPERVISOR_H

#include "keel/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

/** What the supervisor remembers of the real-time tasks between two looks. */
typedef struct keel_supervisor {
    uint32_t skipped; /**< Whole periods that they missed together. */
    uint32_t tasks;   /**< How many there were. */
    uint32_t weight;  /**< 2 for each failed look less 1 for each good one, 0 to 12. */
} keel_supervisor_t;

/**
 * Begins to supervise a scheduler (requirement SUP-001).
 *
 * @param supervisor the supervisor
 * @param scheduler  a scheduler that was started
 */
void keel_supervisor_start(keel_supervisor_t *supervisor, const keel_scheduler_t *scheduler);

/**
 * Whether every real-time task met its releases since the last look (SUP-002 to SUP-005): none
 * missed a whole period, none is waiting beyond its deadline, and none went away; and whether
 * misses were no more than one look in three before, or are long enough ago.
 *
 * @param supervisor the supervisor
 * @param scheduler  the scheduler, between two steps
 * @param now_us     the time, on the scheduler's clock
 */
bool keel_supervisor_met(keel_supervisor_t *supervisor, const keel_scheduler_t *scheduler,
                         uint64_t now_us);

#endif
