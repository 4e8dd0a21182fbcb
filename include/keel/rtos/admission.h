/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file admission.h
 * @brief Whether a set of tasks can be scheduled: checked before flight, one task at a time.
 *
 * The totals of a set are gathered task by task; the first task with which the set breaks a rule
 * is refused, and so can be named. Adding tasks never mends a broken rule, so a set is admitted
 * exactly when each task in turn is. The rules, with W the scheduler's guard, C and T a task's
 * budget and period:
 *
 *     real-time demand   sum of all real-time C + 2 W <= T   for every real-time task
 *     gap                C + W <= T_rt - C_rt                for every other task, every real-time
 *     utilisation        sum of C / T <= limit               over all tasks (eq. 8, 11)
 *
 * The first is what the isolation theorem needs (specs/soundness.md). The second: a real-time
 * task leaves a gap of at most T - C between its runs, and a budget that exceeds it never fits.
 */
#ifndef KEEL_RTOS_ADMISSION_H
#define KEEL_RTOS_ADMISSION_H

#include "keel/c_declarations.h"
#include "keel/rtos/priority.h"
#include "keel/rtos/queue.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** A utilisation of 100 %, in parts per million. */
#define KEEL_UTILISATION_FULL_PPM 1000000u

/** The totals of the tasks admitted so far, with the limits they are held to. */
typedef struct keel_admission {
    uint64_t guard_us;              /**< W, the guard, below 2^31 us. */
    uint64_t utilisation_limit_ppm; /**< The highest utilisation, in ppm. */
    uint64_t utilisation_ppm;       /**< Sum of C / T, each rounded up, in ppm. */
    uint64_t realtime_demand_us;    /**< Sum of the real-time budgets, in us. */
    uint64_t shortest_realtime_us;  /**< Shortest real-time period, in us; UINT64_MAX if none. */
    uint64_t shortest_gap_us;       /**< Shortest T - C of a real-time task; UINT64_MAX if none. */
    uint64_t longest_other_us;      /**< Longest budget of another task, in us. */
    uint64_t tasks;                 /**< How many tasks were admitted. */
} keel_admission_t;

KEEL_C_END

#endif
