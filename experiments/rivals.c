/* SPDX-License-Identifier: Apache-2.0 */
#include "rivals.h"

#include "keel/internal/rtos/decision.h"
#include "keel/internal/rtos/pass.h"

/* Which task that is not real-time runs next, or queue->count. */
typedef uint32_t (*choose_t)(keel_scheduler_t *scheduler, uint64_t now_us);

static uint32_t reading(const keel_scheduler_t *scheduler)
{
    return scheduler->config.read_clock(scheduler->config.clock_context);
}

/* Runs a task of the queue to its end. */
static keel_status_t run(keel_scheduler_t *scheduler, uint32_t position)
{
    const uint32_t slot = scheduler->queue.order[position];
    const keel_task_config_t *const task = scheduler->queue.task[slot];
    const uint64_t start_us = scheduler->clock.now_us;
    keel_status_t status;

    keel_queue_advance(&scheduler->queue, slot, start_us);
    scheduler->stage = KEEL_STAGE_OTHER;
    task->run(task->context);
    status = keel_clock_advance(&scheduler->clock, reading(scheduler));
    scheduler->stage = KEEL_STAGE_READY;
    scheduler->busy_us += scheduler->clock.now_us - start_us;
    keel_stats_record(&scheduler->queue.stats[slot], (uint32_t)(scheduler->clock.now_us - start_us),
                      task->budget_us);
    return status;
}

static keel_status_t begin(keel_scheduler_t *scheduler)
{
    return keel_clock_advance(&scheduler->clock, reading(scheduler));
}

static uint64_t first_release_us(const keel_scheduler_t *scheduler)
{
    uint64_t first_us = KEEL_TIME_NEVER_US;

    for (uint32_t i = 0u; i < scheduler->queue.count; i++) {
        const uint64_t release_us = scheduler->queue.release_us[scheduler->queue.order[i]];

        if ((release_us > scheduler->clock.now_us) && (release_us < first_us)) {
            first_us = release_us;
        }
    }
    return first_us;
}

keel_status_t rival_edf_step(keel_scheduler_t *scheduler)
{
    const keel_status_t status = begin(scheduler);
    uint64_t earliest_us = KEEL_TIME_NEVER_US;
    uint32_t best = scheduler->queue.count;

    if ((status != KEEL_OK) || (scheduler->clock.now_us < scheduler->wake_us)) {
        return status;
    }
    for (uint32_t i = 0u; i < scheduler->queue.count; i++) {
        const uint32_t slot = scheduler->queue.order[i];
        const uint64_t release_us = scheduler->queue.release_us[slot];
        const uint64_t deadline_us = release_us + scheduler->queue.period_us[slot];

        if ((release_us <= scheduler->clock.now_us) && (deadline_us < earliest_us)) {
            earliest_us = deadline_us;
            best = i;
        }
    }
    if (best < scheduler->queue.count) {
        scheduler->wake_us = 0u;
        return run(scheduler, best);
    }
    scheduler->wake_us = first_release_us(scheduler);
    return status;
}

/* A pass as Keel makes it, but for the choice among the other tasks. */
static keel_status_t pass(keel_scheduler_t *scheduler, choose_t choose)
{
    const uint32_t end = scheduler->queue.realtime_count;
    keel_status_t status = begin(scheduler);
    bool ran = false;
    uint32_t i;

    if ((status != KEEL_OK) || (scheduler->clock.now_us < scheduler->wake_us)) {
        return status;
    }
    i = keel_decision_realtime(&scheduler->queue, 0u, end, scheduler->clock.now_us);
    while ((i < end) && (status == KEEL_OK)) {
        status = run(scheduler, i);
        ran = true;
        i = keel_decision_realtime(&scheduler->queue, i + 1u, end, scheduler->clock.now_us);
    }
    i = choose(scheduler, scheduler->clock.now_us);
    scheduler->wake_us = 0u;
    if ((i < scheduler->queue.count) && (status == KEEL_OK)) {
        status = run(scheduler, i);
    } else if (!ran) {
        scheduler->wake_us = first_release_us(scheduler);
    } else {
        /* Real-time tasks ran: look again. */
    }
    return status;
}

/* With unlimited room the kernel's own choice knows no guard. */
static uint32_t choose_unguarded(keel_scheduler_t *scheduler, uint64_t now_us)
{
    const keel_choice_t choice = keel_decision_other(&scheduler->queue, now_us, UINT32_MAX,
                                                     scheduler->config.without_promotion);

    return (choice.priority > 0u) ? choice.position : scheduler->queue.count;
}

keel_status_t rival_unguarded_step(keel_scheduler_t *scheduler)
{
    return pass(scheduler, choose_unguarded);
}

#define EQ3_ONE 65536u /* Eq. 3 is real-valued: here in units of 2^-16. */

/* Eq. 3, without a maximum; a release is one period after the last execution, le. */
static uint64_t eq3(const keel_queue_t *queue, uint32_t slot, uint64_t now_us)
{
    const uint32_t period_us = queue->period_us[slot];
    const uint64_t age_us = (now_us + period_us) - queue->release_us[slot];

    return EQ3_ONE + ((EQ3_ONE * queue->priority[slot] * age_us) / period_us);
}

/* w: the longest run so far, or the declared budget if that is longer. */
static uint64_t worst_us(const keel_queue_t *queue, uint32_t slot)
{
    const uint32_t budget_us = queue->budget_us[slot];
    const uint32_t longest_us = queue->stats[slot].longest_us;

    return (longest_us > budget_us) ? longest_us : budget_us;
}

/* Whether eq. 3 gives the task in a slot more than 0. */
typedef bool (*eligible_t)(const keel_scheduler_t *scheduler, uint32_t slot, uint64_t now_us);

static bool fits(const keel_scheduler_t *scheduler, uint32_t slot, uint64_t now_us)
{
    const uint64_t earliest_us = keel_decision_earliest_us(&scheduler->queue);
    const uint64_t slack_us = (earliest_us > now_us) ? (earliest_us - now_us) : 0u;

    return (scheduler->config.guard_us + worst_us(&scheduler->queue, slot)) <= slack_us;
}

static bool due_and_fits(const keel_scheduler_t *scheduler, uint32_t slot, uint64_t now_us)
{
    return (scheduler->queue.release_us[slot] <= now_us) && fits(scheduler, slot, now_us);
}

/* Its own time to the release, none when it is due, against its own w. */
static bool due_and_fits_itself(const keel_scheduler_t *scheduler, uint32_t slot, uint64_t now_us)
{
    const keel_queue_t *const queue = &scheduler->queue;

    return (queue->release_us[slot] <= now_us) && (worst_us(queue, slot) == 0u);
}

static uint32_t choose(const keel_scheduler_t *scheduler, uint64_t now_us, eligible_t eligible)
{
    const keel_queue_t *const queue = &scheduler->queue;
    uint64_t highest = 0u;
    uint32_t best = queue->count;

    for (uint32_t i = queue->realtime_count; i < queue->count; i++) {
        const uint32_t slot = queue->order[i];

        if (eligible(scheduler, slot, now_us) && (eq3(queue, slot, now_us) > highest)) {
            highest = eq3(queue, slot, now_us);
            best = i;
        }
    }
    return best;
}

static uint32_t choose_fitting(keel_scheduler_t *scheduler, uint64_t now_us)
{
    return choose(scheduler, now_us, due_and_fits);
}

keel_status_t rival_paper_step(keel_scheduler_t *scheduler)
{
    return pass(scheduler, choose_fitting);
}

static uint32_t choose_literal(keel_scheduler_t *scheduler, uint64_t now_us)
{
    return choose(scheduler, now_us, due_and_fits_itself);
}

keel_status_t rival_literal_step(keel_scheduler_t *scheduler)
{
    return pass(scheduler, choose_literal);
}

static uint32_t choose_ungated(keel_scheduler_t *scheduler, uint64_t now_us)
{
    const uint32_t best = choose(scheduler, now_us, fits);

    if (best < scheduler->queue.count) {
        scheduler->queue.release_us[scheduler->queue.order[best]] = now_us; /* le is now. */
    }
    return best;
}

keel_status_t rival_ungated_step(keel_scheduler_t *scheduler)
{
    return pass(scheduler, choose_ungated);
}
