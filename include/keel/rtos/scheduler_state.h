/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file scheduler_state.h
 * @brief The configuration and the state of a scheduler, whose fields may be read freely.
 */
#ifndef KEEL_RTOS_SCHEDULER_STATE_H
#define KEEL_RTOS_SCHEDULER_STATE_H

#include "keel/c_declarations.h"
#include "keel/rtos/admission.h"
#include "keel/rtos/clock.h"
#include "keel/rtos/queue.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** Reads a free-running counter of microseconds, which wraps at 2^32. */
typedef uint32_t (*keel_clock_fn_t)(void *context);

/**
 * How a scheduler is set up.
 *
 * With promotion, which is what zeros mean, a task that does not fit the slack is served from a
 * stated age on nevertheless (WAIT-001). For real-time tasks the bound of ISO-001 then holds as
 * long as no task is promoted.
 *
 * Without promotion a task that is not real-time starts only where its worst-case time fits the
 * slack, and ISO-001 needs no such condition. Waiting is then bounded by nothing but the slack: a
 * task that fits no gap between real-time releases never runs. One overrun can do that, as what
 * never runs forgets nothing (KEEL_STATS_FORGET_RUNS). Removing the task and adding it again clears
 * its statistics, so that its budget counts.
 */
typedef struct keel_scheduler_config {
    keel_clock_fn_t read_clock;     /**< The clock. */
    void *clock_context;            /**< Handed to read_clock; may be null. */
    uint32_t guard_us;              /**< W of eq. 2: time for a decision, below 2^31 us. */
    uint32_t utilisation_limit_ppm; /**< Highest utilisation, at most KEEL_UTILISATION_FULL_PPM. */
    bool without_promotion;         /**< Whether a task that does not fit the slack never runs. */
} keel_scheduler_config_t;

/* The stage of the scheduler. Plain numbers: an enumeration's size differs between compilers. */
#define KEEL_STAGE_SETUP    0 /**< Tasks are being added; not started. */
#define KEEL_STAGE_READY    1 /**< Between two passes. */
#define KEEL_STAGE_PASS     2 /**< In a pass, about to decide. */
#define KEEL_STAGE_REALTIME 3 /**< A real-time task is running. */
#define KEEL_STAGE_OTHER    4 /**< Another task is running. */

/** The position that no task has. */
#define KEEL_POSITION_NONE (-1)

/**
 * A scheduler with its tasks. Its caller owns the memory; read it freely, only the functions of
 * scheduler.h write it.
 *
 * The two earliest releases are bounds that a pass need not look behind: 0 means that nothing is
 * known, and adding and removing a task leave it so. A task that is taken into service moves its
 * release on, so a bound survives it; who finds a bound passed looks at all tasks and renews it.
 *
 * The data of a pass are signed, unlike all others here: provers know memory by its
 * type.
 */
typedef struct keel_scheduler {
    keel_clock_t clock;             /**< The time of the last clock reading. */
    uint64_t wake_us;               /**< Before this time no task can run, in us. */
    uint64_t busy_us;               /**< Time spent in tasks since the start, in us. */
    uint64_t earliest_realtime_us;  /**< No real-time release before; while ahead, just then. */
    uint64_t earliest_other_us;     /**< No release of another task before, in us. */
    keel_scheduler_config_t config; /**< As given to keel_scheduler_init. */
    int16_t cursor;                 /**< In a pass: the next position that FCFS looks at. */
    int16_t pass_end;               /**< In a pass: where its real-time tasks end. */
    int16_t running;                /**< The running task's position, or KEEL_POSITION_NONE. */
    int16_t stage;                  /**< One of KEEL_STAGE_*. */
    keel_queue_t queue;             /**< The tasks. */
} keel_scheduler_t;

/** The data of a task while it is queued. */
typedef struct keel_task_report {
    uint64_t release_us; /**< The next release to serve, on the task's grid, in us. */
    uint16_t skipped;    /**< Whole periods passed unserved; stays at UINT16_MAX. */
    keel_stats_t stats;  /**< How its runs went. */
} keel_task_report_t;

KEEL_C_END

#endif
