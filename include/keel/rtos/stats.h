/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file stats.h
 * @brief Statistics of one task's runs: how long, how often, how often over the budget.
 *
 * Everything is integer arithmetic; what saturates says so in its comment and stops exactly at
 * its limit.
 *
 * Besides what is reported the statistics keep what decisions reckon with: the longest overrun that
 * is remembered. A task's worst-case time w is its budget or this overrun, whichever is longer. The
 * overrun is forgotten after KEEL_STATS_FORGET_RUNS runs in a row within the budget; the longest
 * run that is reported stays.
 */
#ifndef KEEL_RTOS_STATS_H
#define KEEL_RTOS_STATS_H

#include "keel/c_declarations.h"

#include <stdint.h>

KEEL_C_BEGIN

/**
 * So many runs in a row within the budget, and a task's overruns are forgotten.
 *
 * A task that fits no gap with its overrun runs only by promotion, about once in 15 / sp periods:
 * after about 120 / sp of them it is forgotten. On the other side an overrun that comes when none
 * is remembered, and so surprises a decision, comes at most once in any nine runs. A smaller number
 * would sooner forget what happens again.
 */
#define KEEL_STATS_FORGET_RUNS 8u

/** Statistics of one task's runs (fig. 4). All zero at first. */
typedef struct keel_stats {
    uint64_t total_us;      /**< Sum of the counted runs' execution times, in us. */
    uint32_t runs;          /**< Counted runs; stays at UINT32_MAX, then the mean is frozen. */
    uint32_t last_us;       /**< The last run, in us. */
    uint32_t longest_us;    /**< The longest run, in us; never forgotten. */
    uint32_t remembered_us; /**< The longest overrun that decisions reckon with; 0: none. */
    uint32_t forgotten_in;  /**< So many runs within the budget, and it is forgotten. */
    uint16_t overruns;      /**< Runs longer than the budget; stays at UINT16_MAX. */
    uint16_t promotions;    /**< Times it was served by promotion; stays at UINT16_MAX. */
} keel_stats_t;

/**
 * The mean run of a task (requirement STS-005).
 *
 * @param stats the task's statistics
 * @return the mean over the counted runs, rounded down, in us; 0 before the first run
 */
uint64_t keel_stats_mean_us(const keel_stats_t *stats);

KEEL_C_END

#endif
