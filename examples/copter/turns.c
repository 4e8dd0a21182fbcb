/* SPDX-License-Identifier: Apache-2.0 */
/* Whose turn it is on a link. */
#include "turns.h"

#define MILLION 1000000u

void copter_turns_init(copter_turns_t *turns, uint32_t bytes_per_s)
{
    *turns = (copter_turns_t){.bytes_per_s = bytes_per_s,
                              .credit = (uint64_t)COPTER_TURNS_BURST * MILLION};
}

void copter_turns_repeat(copter_turns_t *turns, uint32_t source, uint32_t interval_us)
{
    turns->source[source].interval_us = interval_us;
    turns->source[source].left_us = interval_us;
}

void copter_turns_ask(copter_turns_t *turns, uint32_t source)
{
    turns->source[source].is_due = true;
}

static void wait(copter_source_t *source, uint32_t elapsed_us)
{
    if (source->is_due) {
        const uint32_t room_us = UINT32_MAX - source->waited_us;

        source->waited_us += (elapsed_us < room_us) ? elapsed_us : room_us;
    } else if (source->interval_us > 0u) {
        source->left_us -= (elapsed_us < source->left_us) ? elapsed_us : source->left_us;
        source->is_due = source->left_us == 0u;
    } else {
        /* Nobody asks for it. */
    }
}

void copter_turns_step(copter_turns_t *turns, uint32_t elapsed_us)
{
    const uint64_t most = (uint64_t)COPTER_TURNS_BURST * MILLION;

    turns->credit += (uint64_t)turns->bytes_per_s * elapsed_us;
    if (turns->credit > most) {
        turns->credit = most;
    }
    for (uint32_t i = 0u; i < COPTER_TURNS_SOURCES; i++) {
        wait(&turns->source[i], elapsed_us);
    }
}

uint32_t copter_turns_next(const copter_turns_t *turns)
{
    uint32_t next = COPTER_TURNS_NONE;

    for (uint32_t i = 0u; i < COPTER_TURNS_SOURCES; i++) {
        const copter_source_t *const source = &turns->source[i];

        if (source->is_due &&
            ((next == COPTER_TURNS_NONE) || (source->waited_us > turns->source[next].waited_us))) {
            next = i;
        }
    }
    return next;
}

bool copter_turns_affords(const copter_turns_t *turns, uint32_t bytes)
{
    return turns->credit >= ((uint64_t)bytes * MILLION);
}

void copter_turns_sent(copter_turns_t *turns, uint32_t source, uint32_t bytes)
{
    copter_source_t *const self = &turns->source[source];

    turns->credit -= (uint64_t)bytes * MILLION;
    self->is_due = false;
    self->waited_us = 0u;
    self->left_us = self->interval_us;
}
