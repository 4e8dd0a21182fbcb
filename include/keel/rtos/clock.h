/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file clock.h
 * @brief A microsecond clock that never wraps, made from a 32-bit counter that does.
 *
 * The hardware counter is 32 bits wide and wraps every 71.6 minutes. It is widened here, in one
 * place, to 64 bits; above this unit time is monotone and ordinary arithmetic on it is right, so
 * no theorem of the kernel has a wrap-around case. The functions are inline because the
 * scheduler's idle pass, which is little else, runs them on every poll.
 */
#ifndef KEEL_RTOS_CLOCK_H
#define KEEL_RTOS_CLOCK_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** A step of the counter of this size or more is read as a jump backwards, in us. */
#define KEEL_CLOCK_STEP_LIMIT_US 0x80000000u

/** Uptime up to which the proofs hold, in us: 2^62, about 146 000 years. */
#define KEEL_CLOCK_TIME_LIMIT_US 0x4000000000000000u

/** The time of what never happens: a release when there is no task. */
#define KEEL_TIME_NEVER_US UINT64_MAX

/** A widened clock. The caller owns it; only the functions below write it. */
typedef struct keel_clock {
    uint64_t now_us; /**< Time since initialisation, in us. */
    uint32_t raw_us; /**< The counter at the last reading, in us modulo 2^32. */
} keel_clock_t;

/*@ // The time from one reading of the wrapping counter to a later one, less than 2^32 us.
  @ logic integer clock_elapsed(integer from_us, integer to_us) =
  @     (to_us >= from_us) ? to_us - from_us : to_us - from_us + 0x100000000;
  @*/

/**
 * Time from one raw reading to a later one, across the counter's wrap (requirement CLK-001).
 *
 * @param from_us the earlier reading
 * @param to_us   the later reading, less than 2^32 us after it
 * @return the difference in us
 */
/*@ assigns \nothing;
  @ ensures CLK_001: \result == clock_elapsed(from_us, to_us);
  @*/
static inline uint32_t keel_clock_elapsed_us(uint32_t from_us, uint32_t to_us)
{
    /* Two branches rather than a wrapping subtraction: no operation here overflows. */
    return (to_us >= from_us) ? (to_us - from_us) : ((UINT32_MAX - from_us) + to_us + 1u);
}

/**
 * Starts time at 0, with the counter at a given reading (requirement CLK-002).
 *
 * @param clock  the clock to initialise
 * @param raw_us the counter now
 */
/*@ requires \valid(clock);
  @ assigns clock->now_us, clock->raw_us;
  @ ensures CLK_002: clock->now_us == 0 && clock->raw_us == raw_us;
  @*/
static inline void keel_clock_init(keel_clock_t *clock, uint32_t raw_us)
{
    clock->now_us = 0u;
    clock->raw_us = raw_us;
}

/**
 * Moves time on to a new reading of the counter (requirements CLK-003 and CLK-004).
 *
 * @param clock  the clock, whose time is below KEEL_CLOCK_TIME_LIMIT_US
 * @param raw_us the counter now, read less than 2^31 us after the last reading
 * @return KEEL_OK, or KEEL_ERR_CLOCK when the reading lies behind the last one: a step of
 *         KEEL_CLOCK_STEP_LIMIT_US or more looks like a step backwards
 */
/*@ requires \valid(clock);
  @ requires clock->now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns clock->now_us, clock->raw_us;
  @ behavior backwards:
  @   assumes clock_elapsed(clock->raw_us, raw_us) >= KEEL_CLOCK_STEP_LIMIT_US;
  @   assigns \nothing;
  @   ensures CLK_004: \result == KEEL_ERR_CLOCK;
  @   ensures CLK_004_kept: clock->now_us == \old(clock->now_us) &&
  @                         clock->raw_us == \old(clock->raw_us);
  @ behavior forwards:
  @   assumes clock_elapsed(clock->raw_us, raw_us) < KEEL_CLOCK_STEP_LIMIT_US;
  @   assigns clock->now_us, clock->raw_us;
  @   ensures CLK_003: clock->now_us == \old(clock->now_us)
  @                                     + clock_elapsed(\old(clock->raw_us), raw_us);
  @   ensures raw: clock->raw_us == raw_us;
  @   ensures ok: \result == KEEL_OK;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
static inline keel_status_t keel_clock_advance(keel_clock_t *clock, uint32_t raw_us)
{
    const uint32_t elapsed_us = keel_clock_elapsed_us(clock->raw_us, raw_us);

    if (elapsed_us >= KEEL_CLOCK_STEP_LIMIT_US) {
        return KEEL_ERR_CLOCK;
    }
    clock->now_us += elapsed_us;
    clock->raw_us = raw_us;
    return KEEL_OK;
}

KEEL_C_END

#endif
