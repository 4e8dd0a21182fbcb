/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file many_scheduled.h
 * @brief Schedulers of chosen content and any number of tasks, of which proof_task may be one.
 */
#ifndef MANY_SCHEDULED_H
#define MANY_SCHEDULED_H

#include "../common/many_tasks.h"
#include "scheduler_parts.h"

static void choose_scheduler(uint32_t count, uint32_t realtime_count, int16_t stage)
{
    scheduler = (keel_scheduler_t){.queue = queue_of(count, realtime_count)};
    scheduler.config.read_clock = any_clock;
    scheduler.config.guard_us = 2u;
    scheduler.config.utilisation_limit_ppm = KEEL_UTILISATION_FULL_PPM;
    scheduler.clock.now_us = 4000u;
    scheduler.busy_us = 70u;
    scheduler.stage = stage;
    scheduler.running = KEEL_POSITION_NONE;
    scheduler.earliest_realtime_us = 5000u;
    scheduler.earliest_other_us = 5000u;
}

/* From here on the model and the code may change theirs. */
static void begin(void)
{
    before = scheduler;
    expected = scheduler;
}

#endif
