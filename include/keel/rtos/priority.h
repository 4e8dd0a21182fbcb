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

/*@ predicate priority_valid(integer sp) =
  @     (1 <= sp <= KEEL_PRIORITY_HIGH) || sp == KEEL_PRIORITY_REALTIME;
  @
  @ predicate period_valid(integer period_us) = 0 < period_us < KEEL_PERIOD_LIMIT_US;
  @
  @ // Eq. 3 in exact arithmetic: division of integers that are not negative rounds down.
  @ logic integer dynamic_priority(integer sp, integer age_us, integer period_us) =
  @     (sp * age_us >= (KEEL_PRIORITY_REALTIME - 1) * period_us)
  @         ? KEEL_PRIORITY_REALTIME
  @         : 1 + (sp * age_us) / period_us;
  @
  @ // (max - 1) * T / sp, rounded up: the age at which eq. 3 saturates.
  @ logic integer promotion_age(integer sp, integer period_us) =
  @     ((KEEL_PRIORITY_REALTIME - 1) * period_us + sp - 1) / sp;
  @
  @ lemma PRI_scale: \forall integer s, a, b; 0 <= s ==> a <= b ==> s * a <= s * b;
  @
  @ lemma PRI_quotient: \forall integer a, b, d; 0 <= a <= b ==> 0 < d ==> a / d <= b / d;
  @
  @ lemma PRI_quotient_below: \forall integer a, k, d;
  @     0 <= a ==> 0 < d ==> 0 < k ==> a < k * d ==> a / d < k;
  @
  @ lemma PRI_ceiling: \forall integer a, d, limit;
  @     0 <= a ==> 0 < d ==> 0 < limit ==> (d * a >= limit <==> a >= (limit + d - 1) / d);
  @
  @ // Requirement PRI-002: dp stays within its scale.
  @ lemma PRI_002_range: \forall integer sp, age_us, period_us;
  @     1 <= sp ==> 0 <= age_us ==> 0 < period_us ==>
  @     1 <= dynamic_priority(sp, age_us, period_us) <= KEEL_PRIORITY_REALTIME;
  @
  @ // Requirement PRI-004: a task is promoted from this age on, and not before.
  @ lemma PRI_004_promotion: \forall integer sp, age_us, period_us;
  @     1 <= sp ==> 0 <= age_us ==> 0 < period_us ==>
  @     (dynamic_priority(sp, age_us, period_us) == KEEL_PRIORITY_REALTIME
  @         <==> age_us >= promotion_age(sp, period_us));
  @
  @ // Only the real-time priority itself saturates within its first period.
  @ lemma PRI_005_not_at_release: \forall integer sp, period_us;
  @     1 <= sp < KEEL_PRIORITY_REALTIME - 1 ==> 0 < period_us ==>
  @     promotion_age(sp, period_us) >= period_us;
  @
  @ // Requirement PRI-003: dp never falls while a task waits.
  @ lemma PRI_003_monotone: \forall integer sp, age_us, later_us, period_us;
  @     1 <= sp ==> 0 <= age_us <= later_us ==> 0 < period_us ==>
  @     dynamic_priority(sp, age_us, period_us) <= dynamic_priority(sp, later_us, period_us);
  @*/

/**
 * Whether eq. 3 has saturated, so that the task is promoted (requirement PRI-004).
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param age_us    time since the previous release on the grid, in us
 * @param period_us period, 1 to 2^31 - 1 us
 */
/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures PRI_004: \result <==>
  @     dynamic_priority(sp, age_us, period_us) == KEEL_PRIORITY_REALTIME;
  @*/
bool keel_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us);

/**
 * The dynamic priority of eq. 3 with saturation (requirement PRI-001).
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param age_us    time since the previous release on the grid, in us
 * @param period_us period, 1 to 2^31 - 1 us
 * @return 1 to KEEL_PRIORITY_REALTIME
 */
/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures PRI_001: \result == dynamic_priority(sp, age_us, period_us);
  @ ensures PRI_002: 1 <= \result <= KEEL_PRIORITY_REALTIME;
  @*/
uint32_t keel_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us);

/**
 * The age at which eq. 3 saturates and a task is promoted: (max - 1) * T / sp, rounded up
 * (requirement PRI-004). Before this age a task is never promoted, from it on it always is.
 *
 * @param sp        static priority, 1 to KEEL_PRIORITY_REALTIME
 * @param period_us period, 1 to 2^31 - 1 us
 * @return the age in us, below 2^35
 */
/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures range: 0 < \result < (KEEL_PRIORITY_REALTIME * KEEL_PERIOD_LIMIT_US);
  @ ensures PRI_004: \result == promotion_age(sp, period_us);
  @*/
uint64_t keel_priority_promotion_age_us(uint32_t sp, uint32_t period_us);

KEEL_C_END

#endif
