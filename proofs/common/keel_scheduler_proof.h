/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file keel_scheduler_proof.h
 * @brief What the harnesses of the scheduler share: any valid scheduler, and its comparison.
 */
#ifndef KEEL_SCHEDULER_PROOF_H
#define KEEL_SCHEDULER_PROOF_H

#include "decision_contracts.h"
#include "keel/rtos/scheduler.h"
#include "keel_proof.h"

/* The clock may read anything, and reads the same for the model and for the code; how often it is
 * read, by each. */
static uint32_t clock_reading;
static uint32_t clock_readings;
static uint32_t model_readings;

static uint32_t any_clock(void *context)
{
    (void)context;
    clock_readings++;
    return clock_reading;
}

/* Between the model's call and the code's. */
static void read_again(void)
{
    model_readings = clock_readings;
    clock_readings = 0u;
}

static bool is_read_as_often(void)
{
    return clock_readings == model_readings;
}

/* Any valid state of the scheduler (scheduler_state) around a queue that is there already, with any
 * bounds that are right (realtime_bound, other_bound, realtime_exact): one that lies ahead is
 * never, or the release of some task. */
static void any_state(keel_scheduler_t *scheduler)
{
    const keel_queue_t *const queue = &scheduler->queue;
    const uint32_t earliest = any_below(CAPACITY);

    clock_reading = nondet_u32();
    scheduler->config.read_clock = any_clock;
    scheduler->config.clock_context = NULL;
    scheduler->config.guard_us = any_bits(31u);
    scheduler->config.utilisation_limit_ppm = any_below(KEEL_UTILISATION_FULL_PPM + 1u);
    scheduler->config.without_promotion = nondet_bool();
    scheduler->clock.raw_us = nondet_u32();
    scheduler->clock.now_us = nondet_u64();
    __CPROVER_assume(scheduler->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US);
    scheduler->busy_us = nondet_u64();
    __CPROVER_assume(scheduler->busy_us <= scheduler->clock.now_us);
    scheduler->stage = (int16_t)any_below((uint32_t)KEEL_STAGE_OTHER + 1u);
    scheduler->wake_us = (scheduler->stage < KEEL_STAGE_PASS) ? nondet_u64() : 0u;
    scheduler->pass_end = (int16_t)any_below(queue->realtime_count + 1u);
    scheduler->cursor = (int16_t)any_below((uint32_t)scheduler->pass_end + 1u);
    scheduler->running = nondet_s16();
    __CPROVER_assume((KEEL_POSITION_NONE <= scheduler->running) &&
                     (scheduler->running < queue->count));
    scheduler->earliest_realtime_us = nondet_u64();
    scheduler->earliest_other_us = nondet_u64();
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        const uint64_t release_us = queue->release_us[slot_at(i)];

        __CPROVER_assume((i >= queue->realtime_count) ||
                         (scheduler->earliest_realtime_us <= release_us));
        __CPROVER_assume(!is_other(queue, i) || (scheduler->earliest_other_us <= release_us));
    }
    __CPROVER_assume((scheduler->earliest_realtime_us <= scheduler->clock.now_us) ||
                     (scheduler->earliest_realtime_us == KEEL_TIME_NEVER_US) ||
                     ((earliest < queue->realtime_count) &&
                      (scheduler->earliest_realtime_us ==
                       queue->release_us[queue->order[earliest]])));
}

/* Any valid scheduler; the task that the harness is about stands at a position, if that is within
 * the queue. */
static void any_scheduler(keel_scheduler_t *scheduler, uint32_t of_interest)
{
    any_queue(&scheduler->queue, of_interest);
    any_state(scheduler);
}

static bool setup_same(const keel_scheduler_config_t *a, const keel_scheduler_config_t *b)
{
    return (a->read_clock == b->read_clock) && (a->clock_context == b->clock_context) &&
           (a->guard_us == b->guard_us) && (a->utilisation_limit_ppm == b->utilisation_limit_ppm) &&
           (a->without_promotion == b->without_promotion);
}

/* Whether two schedulers are the same, as seen at a position and slot: if at any, they are. */
static bool scheduler_same(const keel_scheduler_t *a, const keel_scheduler_t *b, uint32_t x)
{
    return setup_same(&a->config, &b->config) && clock_same(&a->clock, &b->clock) &&
           (a->wake_us == b->wake_us) && (a->busy_us == b->busy_us) &&
           (a->earliest_realtime_us == b->earliest_realtime_us) &&
           (a->earliest_other_us == b->earliest_other_us) && (a->stage == b->stage) &&
           (a->cursor == b->cursor) && (a->pass_end == b->pass_end) && (a->running == b->running) &&
           queue_same(&a->queue, &b->queue, x);
}

#endif
