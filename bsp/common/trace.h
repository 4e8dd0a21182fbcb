/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file trace.h
 * @brief A trace of a scheduler's tasks: a record for each run, made by whoever wraps their bodies.
 *
 * The kernel knows nothing of it. A body that all tasks share, and that calls what each does, needs
 * three lines, or none where nobody wants a trace:
 *
 *     static void body(void *context)
 *     {
 *         keel_trace_begin(&trace, &scheduler);
 *         work(context);
 *         keel_trace_end(&trace, &scheduler);
 *         keel_trace_store(&trace, &ring);
 *     }
 *
 * Whoever has time, between two steps say, takes the records out of the ring as messages of a log
 * (trace_log.h). What finds no room is lost, and the trace tells when, and for how long.
 */
#ifndef KEEL_BSP_COMMON_TRACE_H
#define KEEL_BSP_COMMON_TRACE_H

#include "keel/middleware/log_ring.h"
#include "keel/rtos/scheduler.h"

#include <stdint.h>

/** Bytes of a record: its fields, the lowest byte first, without what a compiler adds behind. */
#define KEEL_TRACE_RUN_BYTES 20u

/** @name What else is known of a run. */
/** @{ */
#define KEEL_TRACE_FIRST    0x01u /**< The task's first since it was added. */
#define KEEL_TRACE_PROMOTED 0x02u /**< It was served by promotion, whatever the slack. */
#define KEEL_TRACE_LOST     0x80u /**< No run: records were lost, see keel_trace_store. */
/** @} */

/** A run of a task. */
typedef struct keel_trace_run {
    uint64_t start_us;  /**< When it was chosen: the scheduler's time. */
    uint32_t late_us;   /**< From its release until then; stays at UINT32_MAX. */
    uint32_t length_us; /**< From then until it ended, which is what the scheduler records. */
    uint16_t skipped;   /**< Whole periods that passed between. */
    uint8_t slot;       /**< Where the scheduler's queue has the task. */
    uint8_t flags;      /**< KEEL_TRACE_FIRST, ... */
} keel_trace_run_t;

/** What a trace remembers. Written by the functions below alone; all of it may be read. */
typedef struct keel_trace {
    keel_trace_run_t run; /**< The one that began, or ended, last. */
    uint16_t skipped[KEEL_QUEUE_CAPACITY];
    uint16_t promotions[KEEL_QUEUE_CAPACITY];
} keel_trace_t;

/**
 * Begins a trace, at any time but from within a task (requirement TRC-001).
 *
 * @param trace     the trace
 * @param scheduler whose runs are to be traced
 */
void keel_trace_start(keel_trace_t *trace, const keel_scheduler_t *scheduler);

/**
 * Notes that a run begins (requirements TRC-002 to TRC-004). The scheduler's counters of skipped
 * periods and promotions stay at their ends; there, none is seen any more.
 *
 * @param trace     the trace
 * @param scheduler the scheduler, from within the task, before it does anything
 */
void keel_trace_begin(keel_trace_t *trace, const keel_scheduler_t *scheduler);

/**
 * Notes that the run ends: trace->run is known (requirement TRC-005). Reads the clock once.
 *
 * @param trace     the trace
 * @param scheduler the scheduler, from within the task, which does nothing more
 */
void keel_trace_end(keel_trace_t *trace, const keel_scheduler_t *scheduler);

/**
 * Stores the run as a record, and before it what was lost, as soon as there is room for both
 * (requirement TRC-006): a record whose flags are KEEL_TRACE_LOST, whose start is that of the first
 * run that was lost, whose length is the time from there to this run's start, up to UINT32_MAX, and
 * which is zero else.
 *
 * @param trace the trace, behind keel_trace_end
 * @param ring  the ring, initialised, for this trace alone
 */
void keel_trace_store(const keel_trace_t *trace, keel_log_ring_t *ring);

#endif
