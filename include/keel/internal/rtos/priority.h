/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/priority.h
 * @brief The contracts of priority.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_PRIORITY_H
#define KEEL_INTERNAL_RTOS_PRIORITY_H

#include "keel/c_declarations.h"
#include "keel/rtos/priority.h"

KEEL_C_BEGIN

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

/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures PRI_004: \result <==>
  @     dynamic_priority(sp, age_us, period_us) == KEEL_PRIORITY_REALTIME;
  @*/
bool keel_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us);

/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures PRI_001: \result == dynamic_priority(sp, age_us, period_us);
  @ ensures PRI_002: 1 <= \result <= KEEL_PRIORITY_REALTIME;
  @*/
uint32_t keel_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us);

/*@ requires 1 <= sp <= KEEL_PRIORITY_REALTIME;
  @ requires period_valid(period_us);
  @ assigns \nothing;
  @ ensures range: 0 < \result < (KEEL_PRIORITY_REALTIME * KEEL_PERIOD_LIMIT_US);
  @ ensures PRI_004: \result == promotion_age(sp, period_us);
  @*/
uint64_t keel_priority_promotion_age_us(uint32_t sp, uint32_t period_us);

KEEL_C_END

#endif
