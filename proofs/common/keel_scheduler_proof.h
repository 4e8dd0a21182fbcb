/**
 * @file keel_scheduler_proof.h
 * @brief What the harnesses of the scheduler share: any valid scheduler, and its comparison.
 */
#ifndef KEEL_SCHEDULER_PROOF_H
#define KEEL_SCHEDULER_PROOF_H

#include "keel/rtos/scheduler.h"
#include "keel_proof.h"

/* The clock's last reading, which may be any. */
static uint32_t clock_reading;

static uint32_t any_clock(void *context)
{
    (void)context;
    clock_reading = nondet_u32();
    return clock_reading;
}

static void any_setup(keel_scheduler_config_t *config)
{
    config->read_clock = any_clock;
    config->clock_context = NULL;
    config->guard_us = any_bits(31u);
    config->utilisation_limit = any_below(KEEL_UTILISATION_FULL_PPM + 1u);
}

/* Any valid state of the scheduler (scheduler_state) around a queue that is there already. */
static void any_state(keel_scheduler_t *scheduler)
{
    any_setup(&scheduler->config);
    scheduler->clock.raw_us = nondet_u32();
    scheduler->clock.now_us = nondet_u64();
    __CPROVER_assume(scheduler->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US);
    scheduler->busy_us = nondet_u64();
    __CPROVER_assume(scheduler->busy_us <= scheduler->clock.now_us);
    scheduler->stage = any_below(KEEL_STAGE_OTHER + 1u);
    scheduler->wake_us = (scheduler->stage < KEEL_STAGE_PASS) ? nondet_u64() : 0u;
    scheduler->pass_end = any_below(scheduler->queue.realtime_count + 1u);
    scheduler->cursor = any_below(scheduler->pass_end + 1u);
    scheduler->running = KEEL_INDEX_NONE;
    if ((scheduler->queue.count > 0u) && nondet_bool()) {
        scheduler->running = any_below(scheduler->queue.count);
    }
    scheduler->ran = nondet_bool();
}

/* Until the start no time has passed, and every task waits for its phase (setup_armed). */
static void wait_for_the_start(keel_scheduler_t *scheduler, uint32_t most)
{
    if (scheduler->stage == KEEL_STAGE_SETUP) {
        scheduler->clock.now_us = 0u;
        scheduler->busy_us = 0u;
        for (uint32_t t = 0u; t < most; t++) {
            proof_task[t]->release_us = proof_config[t]->phase_us;
        }
    }
}

static void any_scheduler_of(keel_scheduler_t *scheduler, uint32_t most)
{
    any_queue_of(&scheduler->queue, most);
    any_state(scheduler);
}

/* Asserts what SCH_006 says of a scheduler besides its queue (scheduler_state). */
static void assert_scheduler_valid(const keel_scheduler_t *scheduler)
{
    assert_queue_valid(&scheduler->queue);
    __CPROVER_assert((scheduler->cursor <= scheduler->pass_end) &&
                         (scheduler->pass_end <= scheduler->queue.realtime_count),
                     "SCH_006_state: the pass lies within the real-time tasks");
    __CPROVER_assert((scheduler->running == KEEL_INDEX_NONE) ||
                         (scheduler->running < scheduler->queue.count),
                     "SCH_006_state: the running task is in the queue");
    __CPROVER_assert(scheduler->stage <= KEEL_STAGE_OTHER, "SCH_006_state: the stage is one");
    __CPROVER_assert((scheduler->stage < KEEL_STAGE_PASS) || (scheduler->wake_us == 0u),
                     "SCH_006_state: nothing waits in a pass");
}

static bool setup_same(const keel_scheduler_config_t *a, const keel_scheduler_config_t *b)
{
    return (a->read_clock == b->read_clock) && (a->clock_context == b->clock_context) &&
           (a->guard_us == b->guard_us) && (a->utilisation_limit == b->utilisation_limit);
}

/* Whether two queues are the same, as seen at an index. */
static bool queue_same(const keel_queue_t *a, const keel_queue_t *b, uint32_t i)
{
    return (a->count == b->count) && (a->realtime_count == b->realtime_count) &&
           (a->task[i] == b->task[i]);
}

static bool clock_same(const keel_clock_t *a, const keel_clock_t *b)
{
    return (a->now_us == b->now_us) && (a->raw_us == b->raw_us);
}

/* Whether two schedulers are the same, as seen at an index of their queues. */
static bool scheduler_same(const keel_scheduler_t *a, const keel_scheduler_t *b, uint32_t i)
{
    return queue_same(&a->queue, &b->queue, i) && setup_same(&a->config, &b->config) &&
           clock_same(&a->clock, &b->clock) && (a->wake_us == b->wake_us) &&
           (a->busy_us == b->busy_us) && (a->stage == b->stage) && (a->cursor == b->cursor) &&
           (a->pass_end == b->pass_end) && (a->running == b->running) && (a->ran == b->ran);
}

#endif
