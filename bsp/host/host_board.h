/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file host_board.h
 * @brief The virtual board: a clock that only work moves on; the scheduler's own work costs time.
 *
 * Time is a number of nanoseconds. The scheduler reads it as a free-running counter of microseconds
 * that wraps at 2^32, as on hardware. Three things cost time besides the bodies of tasks:
 *
 *     turn      one turn of the main loop: each step, whether it does anything or not
 *     pass      a step that looks at the tasks, from its reading of the clock on
 *     dispatch  handing the processor to one task
 *
 * A board belongs to one scheduler. What it cannot show is what only hardware can tell: caches, bus
 * contention, interrupts, and whether the costs are right.
 */
#ifndef KEEL_BSP_HOST_BOARD_H
#define KEEL_BSP_HOST_BOARD_H

#include "keel/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

#define HOST_NS_PER_US 1000u

/** What the scheduler's own work costs, in ns. */
typedef struct host_costs {
    uint32_t turn_ns;
    uint32_t pass_ns;
    uint32_t dispatch_ns;
} host_costs_t;

/** A board. Read it freely. */
typedef struct host_board {
    const keel_scheduler_t *scheduler; /**< Whose clock this is. */
    host_costs_t costs;
    uint64_t now_ns;   /**< Time since power-up. */
    uint32_t first_us; /**< The counter at power-up. */
    uint64_t passes;   /**< Steps that looked at the tasks. */
} host_board_t;

/**
 * Powers up a board.
 *
 * @param board     the board
 * @param scheduler whose clock it is
 * @param costs     what the scheduler's work costs
 * @param first_us  the counter now; near 2^32 it soon wraps
 */
void host_board_init(host_board_t *board, const keel_scheduler_t *scheduler,
                     const host_costs_t *costs, uint32_t first_us);

/** The counter, as a keel_clock_fn_t: its context is the board. A pass that begins with this
 * reading takes its time after it. */
uint32_t host_board_read(void *board);

/** Work for some time, in ns: what the body of a task does. The dispatch is added. */
void host_board_work(host_board_t *board, uint64_t work_ns);

/** One turn of the main loop. */
void host_board_turn(host_board_t *board);

/**
 * Skips the turns in which the scheduler is known to have nothing to do: those before its wake-up
 * time (requirement SCH-012). The board is then as if each had been made.
 *
 * @param board  the board, between two steps
 * @param end_ns the turn that reaches this time is not skipped
 */
void host_board_idle(host_board_t *board, uint64_t end_ns);

#endif
