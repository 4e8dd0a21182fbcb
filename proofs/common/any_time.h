/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file any_time.h
 * @brief A scheduler with any time, for functions that look at nothing else.
 */
#ifndef ANY_TIME_H
#define ANY_TIME_H

#include "keel_scheduler_proof.h"

/* More schedulers than the valid ones: nothing is known but that the time lies within its limits.
 * The solver is spared all that makes a queue valid. */
static void any_time(keel_scheduler_t *scheduler)
{
    clock_reading = nondet_u32();
    scheduler->config.read_clock = any_clock;
    __CPROVER_assume(scheduler->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US);
}

#endif
