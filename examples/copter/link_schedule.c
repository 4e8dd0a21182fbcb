/* SPDX-License-Identifier: Apache-2.0 */
/* Whose turn it is on a link. */
#include "link_schedule.h"

#define MILLION 1000000u

void copter_link_schedule_init(copter_link_schedule_t *schedule, uint32_t bytes_per_s)
{
    *schedule = (copter_link_schedule_t){.bytes_per_s = bytes_per_s,
                                         .credit = (uint64_t)COPTER_LINK_SCHEDULE_BURST * MILLION};
}

void copter_link_schedule_repeat(copter_link_schedule_t *schedule, uint32_t source,
                                 uint32_t interval_us)
{
    schedule->source[source].interval_us = interval_us;
    schedule->source[source].left_us = interval_us;
}

void copter_link_schedule_ask(copter_link_schedule_t *schedule, uint32_t source)
{
    schedule->source[source].is_due = true;
}

static void let_wait(copter_source_t *source, uint32_t elapsed_us)
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

void copter_link_schedule_step(copter_link_schedule_t *schedule, uint32_t elapsed_us)
{
    const uint64_t most = (uint64_t)COPTER_LINK_SCHEDULE_BURST * MILLION;

    schedule->credit += (uint64_t)schedule->bytes_per_s * elapsed_us;
    if (schedule->credit > most) {
        schedule->credit = most;
    }
    for (uint32_t i = 0u; i < COPTER_LINK_SCHEDULE_SOURCES; i++) {
        let_wait(&schedule->source[i], elapsed_us);
    }
}

uint32_t copter_link_schedule_next(const copter_link_schedule_t *schedule)
{
    uint32_t next = COPTER_LINK_SCHEDULE_NONE;

    for (uint32_t i = 0u; i < COPTER_LINK_SCHEDULE_SOURCES; i++) {
        const copter_source_t *const source = &schedule->source[i];

        if (source->is_due && ((next == COPTER_LINK_SCHEDULE_NONE) ||
                               (source->waited_us > schedule->source[next].waited_us))) {
            next = i;
        }
    }
    return next;
}

bool copter_link_schedule_affords(const copter_link_schedule_t *schedule, uint32_t bytes)
{
    return schedule->credit >= ((uint64_t)bytes * MILLION);
}

void copter_link_schedule_sent(copter_link_schedule_t *schedule, uint32_t source, uint32_t bytes)
{
    copter_source_t *const self = &schedule->source[source];

    schedule->credit -= (uint64_t)bytes * MILLION;
    self->is_due = false;
    self->waited_us = 0u;
    self->left_us = self->interval_us;
}
