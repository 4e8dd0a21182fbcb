/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file step_contracts.h
 * @brief What a turn of a pass knows of next and finish, a pass of a turn, and a step of a pass.
 *
 * A part of the contracts in pass.h, as expressions of C: the stage, the pass, and the one
 * real-time task that the theorem about a pass is about. Each part's own harness proves that it
 * keeps them; in the harnesses of the turn, the pass and the step they stand in for the parts.
 */
#ifndef STEP_CONTRACTS_H
#define STEP_CONTRACTS_H

#include "keel/internal/rtos/pass.h"

static bool keel_pass_next_may(const keel_scheduler_t *scheduler)
{
    return (scheduler != NULL) && (0 <= scheduler->cursor) &&
           (scheduler->cursor <= scheduler->pass_end);
}

/* As seen at a position at which the task is due before the call, or not. */
static bool keel_pass_next_does(const keel_task_config_t *task, const keel_scheduler_t *before,
                                const keel_scheduler_t *after, uint32_t i, bool due)
{
    const bool in_pass = (before->cursor <= i) && (i < before->pass_end);

    if (before->stage != KEEL_STAGE_PASS) {
        return (task == NULL) && (after->stage == before->stage);
    }
    if (after->pass_end != before->pass_end) {
        return false;
    }
    if (after->stage == KEEL_STAGE_REALTIME) {
        return (task != NULL) && (before->cursor <= after->running) &&
               (after->running < before->pass_end) && (after->cursor == (after->running + 1)) &&
               (!in_pass || !due || (after->running <= i)) && ((i != after->running) || due);
    }
    return (after->stage == ((task != NULL) ? KEEL_STAGE_OTHER : KEEL_STAGE_READY)) &&
           (after->cursor == after->pass_end) && (!in_pass || !due);
}

static bool keel_pass_finish_may(const keel_scheduler_t *scheduler)
{
    return scheduler != NULL;
}

static bool keel_pass_finish_does(keel_status_t status, const keel_scheduler_t *before,
                                  const keel_scheduler_t *after)
{
    if ((before->stage != KEEL_STAGE_REALTIME) && (before->stage != KEEL_STAGE_OTHER)) {
        return (status == KEEL_ERR_STATE) && (after->stage == before->stage);
    }
    return ((status == KEEL_OK) || (status == KEEL_ERR_CLOCK)) &&
           (after->stage == (((status == KEEL_OK) && (before->stage == KEEL_STAGE_REALTIME))
                                 ? KEEL_STAGE_PASS
                                 : KEEL_STAGE_READY)) &&
           (after->cursor == before->cursor) && (after->pass_end == before->pass_end) &&
           (after->running == KEEL_POSITION_NONE);
}

/* How many real-time tasks the pass has yet to look at. */
static int32_t pass_left(const keel_scheduler_t *scheduler)
{
    return (int32_t)scheduler->pass_end - scheduler->cursor;
}

static bool keel_pass_turn_may(const keel_scheduler_t *scheduler)
{
    return (scheduler != NULL) && (KEEL_STAGE_SETUP <= scheduler->stage) &&
           (scheduler->stage <= KEEL_STAGE_OTHER) && (KEEL_POSITION_NONE <= scheduler->running) &&
           (0 <= scheduler->cursor) && (scheduler->cursor <= scheduler->pass_end);
}

/* Outside of a pass it does nothing: as far as is said here, the stage stays. */
static bool keel_pass_turn_does(keel_status_t status, const keel_scheduler_t *before,
                                const keel_scheduler_t *after)
{
    if (before->stage != KEEL_STAGE_PASS) {
        return (status == KEEL_OK) && (after->stage == before->stage);
    }
    return (0 <= after->cursor) && (after->cursor <= after->pass_end) &&
           (((after->stage == KEEL_STAGE_READY) &&
             ((status == KEEL_OK) || (status == KEEL_ERR_CLOCK))) ||
            ((after->stage == KEEL_STAGE_PASS) && (status == KEEL_OK) &&
             (pass_left(after) < pass_left(before))));
}

static bool keel_pass_run_may(const keel_scheduler_t *scheduler)
{
    return (scheduler != NULL) &&
           ((scheduler->stage == KEEL_STAGE_READY) || (scheduler->stage == KEEL_STAGE_PASS)) &&
           (0 <= scheduler->cursor) && (scheduler->cursor <= scheduler->pass_end) &&
           (scheduler->pass_end <= scheduler->queue.realtime_count) &&
           (scheduler->queue.realtime_count <= KEEL_QUEUE_CAPACITY) &&
           (KEEL_POSITION_NONE <= scheduler->running);
}

static bool keel_pass_run_does(keel_status_t status, const keel_scheduler_t *after)
{
    return ((status == KEEL_OK) || (status == KEEL_ERR_CLOCK)) &&
           (after->stage == KEEL_STAGE_READY);
}

#endif
