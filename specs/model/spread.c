/* SPDX-License-Identifier: Apache-2.0 */
/* By trying: every phase, against every release. No divisor there, no jump, and no end before the
 * last phase; so it is the code's where KEEL_SPREAD_ROUNDS_MAX rounds are enough. */
#include "spread.h"

#include <stdbool.h>
#include <stddef.h>

/* SPR-004: by trying every number. */
uint32_t model_spread_divisor(uint32_t a, uint32_t b)
{
    uint32_t greatest = 1u;

    for (uint32_t d = 1u; d <= a; d++) {
        if (((a % d) == 0u) && ((b % d) == 0u)) {
            greatest = d;
        }
    }
    return greatest;
}

/* What keeps others away from a release. */
typedef struct row {
    uint32_t phase_us;
    uint32_t period_us;
    uint64_t need_us;
} row_t;

/* Whether some release of the second falls into what a release of the first needs: as many releases
 * of the first as the second's period is long, behind which all repeats, each against the next one
 * of the second. */
static bool falls_into(const row_t *first, const row_t *second)
{
    uint64_t time_us = first->phase_us;
    uint64_t next_us = second->phase_us;
    bool falls = false;

    for (uint32_t i = 0u; i < (first->period_us + second->period_us); i++) {
        if (next_us < time_us) {
            next_us += second->period_us;
        } else {
            falls = falls || ((next_us - time_us) < first->need_us);
            time_us += first->period_us;
        }
    }
    return falls;
}

/* SPR-002: whether the phase is free of all that are placed. */
static bool is_free(const row_t *row, const row_t *placed, uint32_t count)
{
    bool is = true;

    for (uint32_t i = 0u; i < count; i++) {
        is = is && !falls_into(row, &placed[i]) && !falls_into(&placed[i], row);
    }
    return is;
}

/* SPR-002: the real-time tasks come first, in queue order; the others by period, equal ones in
 * queue order. */
static bool comes_before(const keel_queue_t *queue, uint32_t i, uint32_t j)
{
    const uint32_t period_us = queue->period_us[queue->order[i]];
    const uint32_t other_us = queue->period_us[queue->order[j]];

    if ((i < queue->realtime_count) || (j < queue->realtime_count) || (period_us == other_us)) {
        return i < j;
    }
    return period_us < other_us;
}

/* The position of the task whose turn it is: as many come before it. */
static uint32_t position_of(const keel_queue_t *queue, uint32_t turn)
{
    uint32_t position = 0u;

    for (uint32_t i = 0u; i < queue->count; i++) {
        uint32_t before = 0u;

        for (uint32_t j = 0u; j < queue->count; j++) {
            before += comes_before(queue, j, i) ? 1u : 0u;
        }
        if (before == turn) {
            position = i;
        }
    }
    return position;
}

/* SPR-002: the first phase that is free, or the period. */
static uint32_t tried_phase_us(row_t row, const row_t *placed, uint32_t count)
{
    for (uint32_t tried_us = 0u; tried_us < row.period_us; tried_us++) {
        row.phase_us = tried_us;
        if (is_free(&row, placed, count)) {
            return tried_us;
        }
    }
    return row.period_us;
}

keel_status_t model_scheduler_spread(keel_scheduler_t *scheduler, uint32_t *crowded)
{
    row_t placed[KEEL_QUEUE_CAPACITY];
    uint32_t row_count = 0u;

    if ((scheduler == NULL) || (crowded == NULL)) {
        return KEEL_ERR_NULL; /* SPR-003 */
    }
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE; /* SPR-003 */
    }
    for (uint32_t turn = 0u; turn < scheduler->queue.count; turn++) {
        const uint32_t x = scheduler->queue.order[position_of(&scheduler->queue, turn)];
        row_t row = {0u, scheduler->queue.period_us[x],
                     (uint64_t)scheduler->queue.budget_us[x] + scheduler->config.guard_us + 1u};

        row.phase_us = tried_phase_us(row, placed, row_count);
        if (row.phase_us < row.period_us) {
            scheduler->queue.release_us[x] = row.phase_us;
            placed[row_count] = row;
            row_count++;
        }
    }
    *crowded = scheduler->queue.count - row_count;
    /* SPR-001: what was known is of other releases. */
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->wake_us = 0u;
    return KEEL_OK;
}
