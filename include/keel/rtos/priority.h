/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file priority.h
 * @brief Static priorities and the dynamic priority of eq. 3.
 *
 * A task that is not real-time competes by its dynamic priority
 *
 *     dp = 1 + sp * age / T        (eq. 3, rounded down, saturated at KEEL_PRIORITY_REALTIME)
 *
 * where age is the time since its last release but one on the grid, so that dp = 1 + sp at the
 * moment of its release. A task whose dp saturates is promoted: the scheduler serves it whether
 * or not it fits the slack, unless it is configured without promotion (scheduler_state.h). With the
 * values below, counted from the previous release:
 *
 *     | class       | sp | promoted at age |
 *     | low         |  1 | 15    periods   |
 *     | medium      |  2 |  7.5  periods   |
 *     | medium-high |  3 |  5    periods   |
 *     | high        |  4 |  3.75 periods   |
 *
 * The real-time value lies far above 1 + KEEL_PRIORITY_HIGH on purpose: were it near, every high
 * task would be promoted as soon as it is released and the guard of eq. 2 would protect nothing.
 */
#ifndef KEEL_RTOS_PRIORITY_H
#define KEEL_RTOS_PRIORITY_H

#include "keel/c_declarations.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

#define KEEL_PRIORITY_LOW         1u
#define KEEL_PRIORITY_MEDIUM      2u
#define KEEL_PRIORITY_MEDIUM_HIGH 3u
#define KEEL_PRIORITY_HIGH        4u
#define KEEL_PRIORITY_REALTIME    16u

/** Periods are below this, in us. */
#define KEEL_PERIOD_LIMIT_US 0x80000000u

/**
 * Whether eq. 3 has saturated, so that the task is promoted (requirement PRI-004).
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param age_us    time since the previous release on the grid, in us
 * @param period_us period, 1 to 2^31 - 1 us
 */
bool keel_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us);

/**
 * The dynamic priority of eq. 3 with saturation (requirement PRI-001).
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param age_us    time since the previous release on the grid, in us
 * @param period_us period, 1 to 2^31 - 1 us
 * @return 1 to KEEL_PRIORITY_REALTIME
 */
uint32_t keel_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us);

/**
 * The age at which eq. 3 saturates and a task is promoted: (max - 1) * T / sp, rounded up
 * (requirement PRI-004). Before this age a task is never promoted, from it on it always is.
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param period_us period, 1 to 2^31 - 1 us
 * @return the age in us, below 2^35
 */
uint64_t keel_priority_promotion_age_us(uint32_t sp, uint32_t period_us);

KEEL_C_END

#endif
