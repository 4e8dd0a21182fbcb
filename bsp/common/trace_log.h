/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file trace_log.h
 * @brief A trace as a log in ULog: topic `run` has each run, topic `task` what each task declares.
 *
 * Whoever has a log of his own takes the formats and makes messages of runs and tasks for it. For
 * all others a keel_trace_log_t makes a whole log of what a ring holds (trace.h):
 *
 *     keel_trace_log_start(&log, &scheduler, &ring);
 *     while (keel_trace_log_next(&log)) { send(log.message.bytes, log.message.size); }
 *
 * `make generate NAME=schedule` shows either.
 */
#ifndef KEEL_BSP_COMMON_TRACE_LOG_H
#define KEEL_BSP_COMMON_TRACE_LOG_H

#include "common/trace.h"
#include "keel/middleware/ulog.h"

#include <stdbool.h>

/** @name The topics. */
/** @{ */
#define KEEL_TRACE_TOPIC_RUN  0u
#define KEEL_TRACE_TOPIC_TASK 1u
#define KEEL_TRACE_TOPICS     2u
/** @} */

/** A log that is being made. */
typedef struct keel_trace_log {
    keel_ulog_message_t message; /**< The last one that keel_trace_log_next made. */
    const keel_scheduler_t *scheduler;
    keel_log_ring_t *ring;
    keel_trace_run_t run;           /**< Taken out of the ring. */
    bool has_run;                   /**< It is yet to be told. */
    uint32_t defined;               /**< How much of what a log begins with was made. */
    bool told[KEEL_QUEUE_CAPACITY]; /**< By slot: whether its task was. */
} keel_trace_log_t;

/**
 * Makes a topic's format (requirement TRC-009). The time of a run is its start, that of a task when
 * it was told.
 *
 * @param format receives it
 * @param topic  KEEL_TRACE_TOPIC_RUN or KEEL_TRACE_TOPIC_TASK
 */
void keel_trace_format(keel_ulog_format_t *format, uint32_t topic);

/**
 * Makes a message of a run (requirement TRC-007).
 *
 * @param message receives it
 * @param number  of the topic in the log
 * @param run     the run
 */
void keel_trace_run_message(keel_ulog_message_t *message, uint16_t number,
                            const keel_trace_run_t *run);

/**
 * Makes a message of what the task in a slot of the scheduler's queue declares, and of the guard
 * (requirement TRC-008).
 *
 * @param message   receives it
 * @param number    of the topic in the log
 * @param scheduler the scheduler
 * @param slot      the slot
 */
void keel_trace_task_message(keel_ulog_message_t *message, uint16_t number,
                             const keel_scheduler_t *scheduler, uint8_t slot);

/**
 * Begins a log.
 *
 * @param log       the log
 * @param scheduler whose trace it is
 * @param ring      where keel_trace_store stores; kept
 */
void keel_trace_log_start(keel_trace_log_t *log, const keel_scheduler_t *scheduler,
                          keel_log_ring_t *ring);

/**
 * Makes the next message (requirements TRC-009 to TRC-011): first what a log begins with, then what
 * the ring holds. A task that is removed before its runs were taken out has no name any more.
 *
 * @param log the log, whose scheduler is between two steps
 * @return whether there is one: log->message
 */
bool keel_trace_log_next(keel_trace_log_t *log);

#endif
