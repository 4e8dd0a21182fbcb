/* SPDX-License-Identifier: Apache-2.0 */
#include "common/supervisor.h"

#define WEIGHT_MISSED 2u  /* Of a look that found something missed; a good one takes 1 away. */
#define WEIGHT_LIMIT  6u  /* From here on good looks do not count. */
#define WEIGHT_MAX    12u /* Well above the limit, or a good look now and then would be enough. */

/* The periods that the real-time tasks missed; a counter at its end counts no more, so that a
 * task there can never be seen to meet its releases again. */
static uint32_t sum_skipped(const keel_scheduler_t *scheduler, bool *counting)
{
    uint32_t sum = 0u;

    *counting = true;
    for (uint32_t i = 0u; i < scheduler->queue.realtime_count; i++) {
        const uint16_t skipped = scheduler->queue.skipped[scheduler->queue.order[i]];

        sum += skipped;
        *counting = *counting && (skipped < UINT16_MAX);
    }
    return sum;
}

static bool all_in_time(const keel_scheduler_t *scheduler, uint64_t now_us)
{
    bool in_time = true;

    for (uint32_t i = 0u; i < scheduler->queue.realtime_count; i++) {
        const uint32_t slot = scheduler->queue.order[i];
        const uint64_t release_us = scheduler->queue.release_us[slot];

        in_time = in_time && (now_us < (release_us + scheduler->queue.period_us[slot]));
    }
    return in_time;
}

void keel_supervisor_start(keel_supervisor_t *supervisor, const keel_scheduler_t *scheduler)
{
    bool counting;

    supervisor->skipped = sum_skipped(scheduler, &counting);
    supervisor->tasks = scheduler->queue.realtime_count;
    supervisor->weight = 0u;
}

/* Good looks between misses must not hide them: more than one miss in three adds up. */
static void note_look(keel_supervisor_t *supervisor, bool good)
{
    if (!good) {
        supervisor->weight += WEIGHT_MISSED;
        supervisor->weight = (supervisor->weight > WEIGHT_MAX) ? WEIGHT_MAX : supervisor->weight;
    } else if (supervisor->weight > 0u) {
        supervisor->weight--;
    } else {
        /* All was well before, too. */
    }
}

bool keel_supervisor_met(keel_supervisor_t *supervisor, const keel_scheduler_t *scheduler,
                         uint64_t now_us)
{
    bool counting;
    const uint32_t skipped = sum_skipped(scheduler, &counting);
    const bool same = (skipped == supervisor->skipped) && counting;
    const bool all_there = (scheduler->queue.realtime_count >= supervisor->tasks) &&
                           (supervisor->tasks > 0u);

    const bool good = same && all_there && all_in_time(scheduler, now_us);

    supervisor->skipped = skipped;
    note_look(supervisor, good);
    return good && (supervisor->weight < WEIGHT_LIMIT);
}
