/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file deviation.h
 * @brief How far the measured periods of a task lie from their target (eq. 15).
 *
 * Everything is integer arithmetic; what would overflow is refused.
 */
#ifndef KEEL_RTOS_DEVIATION_H
#define KEEL_RTOS_DEVIATION_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** How far a task's measured periods lie from their target (eq. 15). All zero at first. */
typedef struct keel_deviation {
    uint64_t sum_us2;  /**< Sum of the squared deviations, in us^2; never wraps. */
    uint64_t start_us; /**< The last start, in us. */
    uint32_t starts;   /**< Starts seen; the first of them ends no period. */
} keel_deviation_t;

/**
 * Adds a start of the task to the deviation of its period (eq. 15, requirement DEV-001).
 *
 * @param deviation the accumulator
 * @param start_us  when the task started, not before its last start, in us
 * @param period_us the target period, in us
 * @return KEEL_OK, or KEEL_ERR_STATE when the sample would overflow the sum or the count, or
 *         its period lies 2^32 us or more from the target; nothing is added then
 */
keel_status_t keel_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                 uint32_t period_us);

/**
 * The mean squared deviation, sigma^2 of eq. 15 (requirement DEV-003). The root is left to whoever
 * prints it, who has floating point.
 *
 * @param deviation the accumulator
 * @return sigma^2 rounded down, in us^2; 0 before the second start
 */
uint64_t keel_deviation_variance_us2(const keel_deviation_t *deviation);

KEEL_C_END

#endif
