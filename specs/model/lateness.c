/* SPDX-License-Identifier: Apache-2.0 */
#include "lateness.h"

#include "admission.h"
#include "queue.h"

#include <stdbool.h>
#include <stddef.h>

static bool is_realtime_task(const keel_queue_t *queue, uint32_t i)
{
    return queue->priority[queue->order[i]] == KEEL_PRIORITY_REALTIME;
}

/* The real-time budgets of all tasks but the one at a position. */
static uint64_t other_realtime_us(const keel_queue_t *queue, uint32_t position)
{
    uint64_t sum_us = 0u;

    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        if ((i < queue->count) && (i != position) && is_realtime_task(queue, i)) {
            sum_us += queue->budget_us[queue->order[i]];
        }
    }
    return sum_us;
}

/* L: the longest budget of a task that is not real-time; 0 if there is none. */
static uint64_t longest_us(const keel_queue_t *queue)
{
    uint64_t most_us = 0u;

    for (uint32_t i = 0u; i < KEEL_QUEUE_CAPACITY; i++) {
        const uint32_t budget_us = queue->budget_us[queue->order[i]];

        if ((i < queue->count) && (!is_realtime_task(queue, i)) && (budget_us > most_us)) {
            most_us = budget_us;
        }
    }
    return most_us;
}

/* LAT-001: the theorems' bounds of the real-time task at a position. */
static keel_lateness_t of_realtime(const keel_scheduler_t *scheduler, uint32_t position,
                                   bool promotes)
{
    const keel_queue_t *const queue = &scheduler->queue;
    const uint32_t own_us = queue->budget_us[queue->order[position]];
    const uint64_t others_us = other_realtime_us(queue, position);
    const uint64_t iso_001_us = others_us + scheduler->config.guard_us;
    const uint64_t iso_002_us = iso_001_us + scheduler->config.guard_us + longest_us(queue);
    const bool short_period = queue->period_us[queue->order[position]] < (iso_002_us + own_us);
    keel_lateness_t told = {.late_us = iso_001_us, .unpromoted_us = iso_001_us};

    if (promotes) {
        told.promotes = true;
        told.skips = short_period;
        told.late_us = short_period ? (iso_002_us + own_us) : iso_002_us;
    }
    return told;
}

keel_status_t model_scheduler_lateness(const keel_scheduler_t *scheduler,
                                       const keel_task_config_t *task, keel_lateness_t *lateness)
{
    keel_admission_t totals;
    keel_status_t status;
    uint32_t position;
    bool promotes;

    if ((scheduler == NULL) || (task == NULL) || (lateness == NULL)) {
        return KEEL_ERR_NULL; /* LAT-003 */
    }
    position = model_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK; /* LAT-003 */
    }
    model_admission_init(&totals, scheduler->config.guard_us,
                         scheduler->config.utilisation_limit_ppm);
    status = model_admission_queue(&totals, &scheduler->queue);
    if (status != KEEL_OK) {
        return status; /* LAT-003 */
    }
    promotes = (!scheduler->config.without_promotion) &&
               (scheduler->queue.count > scheduler->queue.realtime_count);
    if (is_realtime_task(&scheduler->queue, position)) {
        *lateness = of_realtime(scheduler, position, promotes);
    } else {
        /* LAT-002 */
        *lateness = (keel_lateness_t){.late_us = KEEL_TIME_NEVER_US,
                                      .unpromoted_us = KEEL_TIME_NEVER_US,
                                      .promotes = promotes,
                                      .skips = true};
    }
    return KEEL_OK;
}
