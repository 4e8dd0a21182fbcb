/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file log.h
 * @brief The flight's log, in ULog: what is logged, how often, and the way to the storage.
 *
 * At the end of a task's run the topics that are of that task are sampled, at their rates, into a
 * ring; nobody waits. A task of its own moves the ring's bytes to the port. Before that it hands
 * over what a log begins with: formats, parameters, subscriptions; later it writes those parameters
 * whose value in force changes. A record that is lost, because the port is too slow for the ring,
 * is in the log as a dropout.
 */
#ifndef COPTER_LOG_H
#define COPTER_LOG_H

#include "common/trace.h"
#include "keel/middleware/log_ring.h"
#include "keel/middleware/ulog.h"
#include "parameter_table.h"

#include <stdbool.h>
#include <stdint.h>

/** Topics at most. */
#define COPTER_LOG_TOPICS 24u

/** The row of topics that the log's own task samples, once a second. */
#define COPTER_LOG_ROW 0xFFu

/** Tasks whose times are logged, and all that a copter can have. */
#define COPTER_LOG_TASKS 25u

/** A field: a part of copter_t. */
typedef struct copter_log_field {
    keel_ulog_field_t is;
    uint32_t offset; /**< In copter_t, in bytes. */
} copter_log_field_t;

/** Values that are logged together. */
typedef struct copter_topic {
    keel_ulog_name_t name;
    uint8_t instance; /**< Which of several of this name, from 0 on, one behind the other. */
    uint8_t row;      /**< The task of table 2 that writes it, or COPTER_LOG_ROW. */
    uint16_t every;   /**< It is sampled at every so many runs of it. */
    bool gives_way;   /**< It is left out where each run of a task is logged. */
    uint8_t fields;   /**< Without the time, with which each begins. */
    copter_log_field_t field[KEEL_ULOG_FIELDS - 1u];
} copter_topic_t;

/** The topics. */
extern const copter_topic_t copter_topic[];
extern const uint32_t copter_topics;

/** Written by the log, but for the ring, whose tail is its task's. */
typedef struct copter_log {
    keel_log_ring_t ring;
    keel_ulog_message_t message;                /**< Being made. */
    keel_ulog_message_t dropout;                /**< The same. */
    uint32_t defined;                           /**< How much of the log's beginning is written. */
    bool samples;                               /**< All of it. */
    uint32_t rounds;                            /**< Runs of the log's task. */
    uint32_t lost;                              /**< Records, as far as dropouts tell. */
    uint8_t state;                              /**< Of the state machine, as the log has it. */
    uint32_t refusals;                          /**< Of state.refusals, those that it has. */
    uint32_t parameter[COPTER_PARAMETER_COUNT]; /**< The bits of each, as the log has it. */
    uint16_t looked_at;                         /**< Of these, in the last run. */
    uint16_t left[COPTER_LOG_TOPICS];           /**< Runs until a topic is sampled. */
    uint32_t runs[COPTER_LOG_TASKS];            /**< Of each task, and so on. */
    uint32_t busy_us[COPTER_LOG_TASKS];
    uint32_t longest_us[COPTER_LOG_TASKS];
    uint16_t skipped[COPTER_LOG_TASKS];
    bool traces;                    /**< Each run of a task is logged. */
    keel_trace_t trace;             /**< Of the run that began last, whether it is or not. */
    bool told[KEEL_QUEUE_CAPACITY]; /**< By slot: whether what its task declares is in the log. */
} copter_log_t;

#endif
