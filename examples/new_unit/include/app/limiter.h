/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file limiter.h
 * @brief Limits values, and counts those that were too large.
 */
#ifndef APP_LIMITER_H
#define APP_LIMITER_H

#include <stdint.h>

/** The count stays here when it has come so far. */
#define LIMITER_COUNT_MAX 1000u

/** The state: the largest value that passes, and how many were larger. */
typedef struct limiter {
    uint16_t limit;
    uint16_t count;
} limiter_t;

/*@ predicate limiter_valid(limiter_t *limiter) = limiter->count <= LIMITER_COUNT_MAX;
  @*/

/**
 * Starts with a limit, and a count of 0 (requirement LIM-001).
 *
 * @param limiter the state, which is written as a whole
 * @param limit   the largest value that passes as it is
 */
/*@ requires \valid(limiter);
  @ assigns *limiter;
  @ ensures LIM_001_limit: limiter->limit == limit;
  @ ensures LIM_001_count: limiter->count == 0;
  @ ensures valid: limiter_valid(limiter);
  @*/
void limiter_init(limiter_t *limiter, uint16_t limit);

/**
 * Limits a value (requirement LIM-002).
 *
 * @param limiter the state
 * @param value   any value
 * @return the value, or the limit if that is less
 */
/*@ requires \valid(limiter) && limiter_valid(limiter);
  @ assigns limiter->count;
  @ ensures LIM_002_result: \result == \min(value, limiter->limit);
  @ ensures LIM_002_passed: value <= limiter->limit ==> limiter->count == \old(limiter->count);
  @ ensures LIM_002_counted: value > limiter->limit ==>
  @     limiter->count == \min(\old(limiter->count) + 1, LIMITER_COUNT_MAX);
  @ ensures valid: limiter_valid(limiter);
  @*/
uint16_t limiter_step(limiter_t *limiter, uint16_t value);

#endif
