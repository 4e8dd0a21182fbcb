/**
 * @file step_contracts.h
 * @brief What keel_scheduler_step knows of begin, next and finish: their stage and their pass.
 *
 * A part of the contracts in scheduler.h, as expressions of C. Each part's own harness proves that
 * it keeps them; in the harness of the step's order they stand in for the parts.
 */
#ifndef STEP_CONTRACTS_H
#define STEP_CONTRACTS_H

#include "keel/rtos/scheduler.h"

static bool keel_scheduler_begin_may(const keel_scheduler_t *scheduler)
{
    return (scheduler != NULL) && (scheduler->queue.realtime_count <= KEEL_QUEUE_CAPACITY);
}

static bool keel_scheduler_begin_does(keel_status_t status, const keel_scheduler_t *before,
                                      const keel_scheduler_t *after)
{
    if (status != KEEL_OK) {
        return (after->stage == before->stage) &&
               ((status == KEEL_ERR_CLOCK) || (status == KEEL_ERR_STATE));
    }
    return (before->stage == KEEL_STAGE_READY) &&
           ((after->stage == KEEL_STAGE_READY) ||
            ((after->stage == KEEL_STAGE_PASS) && (after->cursor == 0u) &&
             (after->pass_end == before->queue.realtime_count)));
}

static bool keel_scheduler_next_may(const keel_scheduler_t *scheduler)
{
    return (scheduler != NULL) && (scheduler->cursor <= scheduler->pass_end);
}

static bool keel_scheduler_next_does(const keel_task_t *task, const keel_scheduler_t *before,
                                     const keel_scheduler_t *after)
{
    if (before->stage != KEEL_STAGE_PASS) {
        return (task == NULL) && (after->stage == before->stage);
    }
    if (task == NULL) {
        return after->stage == KEEL_STAGE_READY;
    }
    return (after->stage == KEEL_STAGE_OTHER) ||
           ((after->stage == KEEL_STAGE_REALTIME) && (before->cursor < after->cursor) &&
            (after->cursor <= after->pass_end) && (after->pass_end == before->pass_end));
}

static bool keel_scheduler_finish_may(const keel_scheduler_t *scheduler)
{
    return scheduler != NULL;
}

static bool keel_scheduler_finish_does(keel_status_t status, const keel_scheduler_t *before,
                                       const keel_scheduler_t *after)
{
    if ((before->stage != KEEL_STAGE_REALTIME) && (before->stage != KEEL_STAGE_OTHER)) {
        return (status == KEEL_ERR_STATE) && (after->stage == before->stage);
    }
    if ((status == KEEL_OK) && (before->stage == KEEL_STAGE_REALTIME)) {
        return (after->stage == KEEL_STAGE_PASS) && (after->cursor == before->cursor) &&
               (after->pass_end == before->pass_end);
    }
    return (after->stage == KEEL_STAGE_READY) &&
           ((status == KEEL_OK) || (status == KEEL_ERR_CLOCK));
}

#endif
