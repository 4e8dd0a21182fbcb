/* SPDX-License-Identifier: Apache-2.0 */
#include "pass.h"

#include "clock.h"
#include "decision.h"
#include "queue.h"
#include "stats.h"

#include <stdbool.h>
#include <stddef.h>

keel_status_t model_pass_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_status_t status = KEEL_ERR_STATE; /* SCH-013: not started, or a pass is open */

    if (scheduler->stage == KEEL_STAGE_READY) {
        status = model_clock_advance(&scheduler->clock, raw_us); /* SCH-011, SCH-013 */
    }
    if ((status == KEEL_OK) && (scheduler->clock.now_us >= scheduler->wake_us)) {
        /* SCH-011: a pass over all real-time tasks; SCH-012: nothing waits in a pass. */
        scheduler->stage = KEEL_STAGE_PASS;
        scheduler->wake_us = 0u;
        scheduler->cursor = 0;
        scheduler->pass_end = (int16_t)scheduler->queue.realtime_count;
    }
    return status;
}

/* SCH-014: the task at a position is taken into service, and the pass goes on behind it. */
static const keel_task_config_t *serve(keel_scheduler_t *scheduler, uint32_t position,
                                       int16_t stage, uint32_t cursor)
{
    const uint32_t slot = scheduler->queue.order[position];

    model_queue_advance(&scheduler->queue, slot, scheduler->clock.now_us);
    scheduler->running = (int16_t)position;
    scheduler->stage = stage;
    scheduler->cursor = (int16_t)cursor;
    return scheduler->queue.task[slot];
}

/* SCH-016: the one other task of a pass, or its end. */
static const keel_task_config_t *serve_other(keel_scheduler_t *scheduler)
{
    const uint64_t now_us = scheduler->clock.now_us;
    const uint64_t realtime_us = model_decision_earliest_us(&scheduler->queue);
    const uint32_t room_us = model_decision_room_us(realtime_us, now_us,
                                                    scheduler->config.guard_us);
    const bool without_promotion = scheduler->config.without_promotion;
    const keel_choice_t choice = model_decision_other(&scheduler->queue, now_us, room_us,
                                                      without_promotion);
    uint64_t other_us = scheduler->earliest_other_us;

    /* What is remembered: a bound of the other releases stays until it has passed. */
    if (other_us <= now_us) {
        other_us = choice.earliest_us;
    }
    scheduler->earliest_realtime_us = realtime_us;
    scheduler->earliest_other_us = other_us;
    if (choice.priority > 0u) {
        if (!without_promotion && (choice.priority == KEEL_PRIORITY_REALTIME)) {
            model_stats_promote(&scheduler->queue.stats[scheduler->queue.order[choice.position]]);
        }
        return serve(scheduler, choice.position, KEEL_STAGE_OTHER, (uint32_t)scheduler->pass_end);
    }
    /* SCH-012: nothing can run before the next real-time release, and the others' next event. */
    if (other_us <= now_us) {
        other_us = model_decision_event_us(&scheduler->queue, now_us, without_promotion);
    }
    scheduler->wake_us = (realtime_us < other_us) ? realtime_us : other_us;
    scheduler->stage = KEEL_STAGE_READY;
    scheduler->cursor = scheduler->pass_end;
    return NULL;
}

const keel_task_config_t *model_pass_next(keel_scheduler_t *scheduler)
{
    uint32_t first;

    if (scheduler->stage != KEEL_STAGE_PASS) {
        return NULL; /* SCH-014 */
    }
    /* SCH-015: the first due real-time task that the pass has yet to look at. */
    first = model_decision_realtime(&scheduler->queue, (uint32_t)scheduler->cursor,
                                    (uint32_t)scheduler->pass_end, scheduler->clock.now_us);
    if (first < (uint32_t)scheduler->pass_end) {
        return serve(scheduler, first, KEEL_STAGE_REALTIME, first + 1u);
    }
    return serve_other(scheduler);
}

keel_status_t model_pass_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const bool realtime = scheduler->stage == KEEL_STAGE_REALTIME;
    keel_status_t status = KEEL_ERR_STATE; /* SCH-018: no task runs */

    if (realtime || (scheduler->stage == KEEL_STAGE_OTHER)) {
        const uint64_t ran_us = model_clock_elapsed_us(scheduler->clock.raw_us, raw_us);

        status = model_clock_advance(&scheduler->clock, raw_us); /* SCH-017, SCH-018 */
        if ((status == KEEL_OK) && (scheduler->running != KEEL_POSITION_NONE)) {
            const uint32_t slot = scheduler->queue.order[scheduler->running];

            model_stats_record(&scheduler->queue.stats[slot], (uint32_t)ran_us,
                               scheduler->queue.budget_us[slot]); /* SCH-017 */
        }
        scheduler->busy_us += scheduler->clock.now_us - start_us;
        scheduler->running = KEEL_POSITION_NONE;
        scheduler->stage = ((status == KEEL_OK) && realtime) ? KEEL_STAGE_PASS : KEEL_STAGE_READY;
    }
    return status;
}
