/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file turns.h
 * @brief Whose turn it is on a link: messages that are due, and the bytes that it may still carry.
 *
 * A source is a kind of message. It is due when its interval is over, or when it was asked for; of
 * those that are due the one that has waited longest is next, whatever its length. So each one's
 * turn comes after at most one frame of each other source, and a link that is too slow for all of
 * them carries all of them at lower rates. Its interval begins anew when a source was sent.
 *
 * Bytes are counted by a bucket that fills at the link's rate, to at most COPTER_TURNS_BURST.
 */
#ifndef COPTER_TURNS_H
#define COPTER_TURNS_H

#include "messages.h"

#include <stdbool.h>
#include <stdint.h>

#define COPTER_TURNS_SOURCES MESSAGES_SENT

/** The most that a link carries at once, in bytes: more than the longest frame. */
#define COPTER_TURNS_BURST 512u

/** Of all sources no one: none is due. */
#define COPTER_TURNS_NONE COPTER_TURNS_SOURCES

/** A kind of message. */
typedef struct copter_source {
    uint32_t interval_us; /**< 0: only when it is asked for. */
    uint32_t left_us;     /**< Of the interval. */
    uint32_t waited_us;   /**< Since it is due. */
    bool is_due;
} copter_source_t;

/** A link's turns. */
typedef struct copter_turns {
    copter_source_t source[COPTER_TURNS_SOURCES];
    uint32_t bytes_per_s;
    uint64_t credit; /**< In bytes times 10^-6. */
} copter_turns_t;

/** Makes turns without a source, with a full bucket. */
void copter_turns_init(copter_turns_t *turns, uint32_t bytes_per_s);

/** Sets how often a source is due from now on; 0: only when it is asked for. */
void copter_turns_repeat(copter_turns_t *turns, uint32_t source, uint32_t interval_us);

/** Asks for a source once. */
void copter_turns_ask(copter_turns_t *turns, uint32_t source);

/** Time passes. */
void copter_turns_step(copter_turns_t *turns, uint32_t elapsed_us);

/** The source that is next, or COPTER_TURNS_NONE. */
uint32_t copter_turns_next(const copter_turns_t *turns);

/** Whether the link may carry so many bytes now. */
bool copter_turns_affords(const copter_turns_t *turns, uint32_t bytes);

/** A source had its turn, and took so many bytes, no more than are afforded: 0 if there was
 * nothing to send. */
void copter_turns_sent(copter_turns_t *turns, uint32_t source, uint32_t bytes);

#endif
