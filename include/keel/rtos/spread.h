/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spread.h
 * @brief First releases that keep the tasks out of each other's way, found by the kernel itself.
 *
 * Tasks that are released together wait for each other, and start late by turns: that is most of
 * the jitter of a set without phases. Here each task gets the first phase at which it meets no
 * other one, for sets whose phases nobody has worked out (`make analyze ARGS=--phases` does).
 *
 *     keel_scheduler_add(&s, &gyro);        for every task
 *     keel_scheduler_spread(&s, &crowded);  once, behind the last of them
 *     keel_scheduler_start(&s);
 *
 * Two tasks never meet if their releases, modulo the greatest common divisor of their periods, are
 * far enough apart in both directions: by the earlier one's budget, the guard W and a tick of the
 * clock. That is what eq. 2 asks for before a real-time release. Before any other release it leaves
 * time for the decision behind a run, which the guard stands for.
 *
 * Periods with a small common divisor leave little room: 1000 us and 1001 us none at all.
 */
#ifndef KEEL_RTOS_SPREAD_H
#define KEEL_RTOS_SPREAD_H

#include "keel/c_declarations.h"
#include "keel/rtos/queue.h"
#include "keel/rtos/scheduler_state.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** How often the tasks placed before are gone through to place one more, at most. */
#ifndef KEEL_SPREAD_ROUNDS_MAX
#define KEEL_SPREAD_ROUNDS_MAX 32u
#endif

/**
 * The greatest common divisor of two times (requirement SPR-004): two periods come together again
 * and again at every multiple of it.
 *
 * @param a more than 0 and below 2^31
 * @param b below 2^31; of 0 and a it is a
 * @return what divides both
 */
uint32_t keel_spread_divisor(uint32_t a, uint32_t b);

/**
 * Sets the first releases of the tasks so that they do not meet (requirements SPR-001 and SPR-002).
 *
 * The tasks are placed one after the other: the real-time ones in queue order, then the others by
 * period, the shortest first, equal ones in queue order. Each gets the first phase below its period
 * at which it keeps apart from all that are placed. One for which there is none, or none is found
 * in KEEL_SPREAD_ROUNDS_MAX rounds, keeps the phase that it declares, and no other heeds it.
 *
 * @param scheduler a scheduler that was not started yet
 * @param crowded   receives how many tasks keep the phase that they declare; 0: no two ever meet,
 *                  as long as budgets and guard are kept, the loop steps in time, and no task is
 *                  added
 * @return KEEL_OK; KEEL_ERR_NULL; KEEL_ERR_STATE after the start
 */
keel_status_t keel_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded);

KEEL_C_END

#endif
