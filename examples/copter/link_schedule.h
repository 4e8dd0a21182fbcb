/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file link_schedule.h
 * @brief Whose turn it is on a link: messages that are due, and the bytes that it may still carry.
 *
 * A source is a kind of message. It is due when its interval is over, or when it was asked for; of
 * those that are due the one that has waited longest is next, whatever its length. So each one's
 * turn comes after at most one frame of each other source, and a link that is too slow for all of
 * them carries all of them at lower rates. Its interval begins anew when a source was sent.
 *
 * Bytes are counted by a bucket that fills at the link's rate, to at most
 * COPTER_LINK_SCHEDULE_BURST.
 */
#ifndef COPTER_LINK_SCHEDULE_H
#define COPTER_LINK_SCHEDULE_H

#include "mavlink_messages.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_LINK_SCHEDULE_SOURCES MESSAGES_SENT

/** The most that a link carries at once, in bytes: more than the longest frame. */
#define COPTER_LINK_SCHEDULE_BURST 512u

/** Of all sources no one: none is due. */
#define COPTER_LINK_SCHEDULE_NONE COPTER_LINK_SCHEDULE_SOURCES

/** A kind of message. */
typedef struct copter_source {
    uint32_t interval_us; /**< 0: only when it is asked for. */
    uint32_t left_us;     /**< Of the interval. */
    uint32_t waited_us;   /**< Since it is due. */
    bool is_due;
} copter_source_t;

/** A link's schedule. */
typedef struct copter_link_schedule {
    copter_source_t source[COPTER_LINK_SCHEDULE_SOURCES];
    uint32_t bytes_per_s;
    uint64_t credit; /**< In bytes times 10^-6. */
} copter_link_schedule_t;

/** Makes a schedule without a source, with a full bucket. */
void copter_link_schedule_init(copter_link_schedule_t *schedule, uint32_t bytes_per_s);

/** Sets how often a source is due from now on; 0: only when it is asked for. */
void copter_link_schedule_repeat(copter_link_schedule_t *schedule, uint32_t source,
                                 uint32_t interval_us);

/** Asks for a source once. */
void copter_link_schedule_ask(copter_link_schedule_t *schedule, uint32_t source);

/** Time passes. */
void copter_link_schedule_step(copter_link_schedule_t *schedule, uint32_t elapsed_us);

/** The source that is next, or COPTER_LINK_SCHEDULE_NONE. */
uint32_t copter_link_schedule_next(const copter_link_schedule_t *schedule);

/** Whether the link may carry so many bytes now. */
bool copter_link_schedule_affords(const copter_link_schedule_t *schedule, uint32_t bytes);

/** A source had its turn, and took so many bytes, no more than are afforded: 0 if there was
 * nothing to send. */
void copter_link_schedule_sent(copter_link_schedule_t *schedule, uint32_t source, uint32_t bytes);

#endif
