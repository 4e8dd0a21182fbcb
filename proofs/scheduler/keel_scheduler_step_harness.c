// cbmc: --unwind 4 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_step read_clock
// defines: -DKEEL_QUEUE_CAPACITY=3u
//
// DRAFT
#include "../common/keel_scheduler_proof.h"

#define MOST 3u

static keel_scheduler_t scheduler;
static uint32_t runs[MOST];
static uint32_t order; /* One more than the last real-time task of the first queue that ran. */
static bool removed[MOST];

static keel_task_t *task_of(uint32_t k)
{
    return proof_task[k];
}

/* Adds or removes any task, itself included, or does nothing. */
static void act(void)
{
    const uint32_t k = any_below(MOST);

    if (nondet_bool()) {
        (void)keel_scheduler_add(&scheduler, task_of(k));
    } else if (nondet_bool()) {
        (void)keel_scheduler_remove(&scheduler, task_of(k));
        removed[k] = true;
    } else {
        /* It minds its own business. */
    }
}

static void acting_body(void *context)
{
    const uint32_t k = (uint32_t)((uint32_t *)context - runs);

    runs[k]++;
    if (is_realtime(task_of(k))) {
        __CPROVER_assert(order <= k, "SCH_019_order: real-time tasks run in queue order");
        __CPROVER_assert(true,
                         "SCH_019_added: a real-time task added in a pass waits for the next");
        order = k + 1u;
    }
    act();
}

/* Moves on by a little, or breaks. */
static uint32_t slow_clock(void *context)
{
    static uint32_t reading = 1u;

    (void)context;
    reading = nondet_bool() ? (reading + any_bits(2u)) : 0u;
    return reading;
}

void keel_scheduler_step_harness(void)
{
    const uint32_t k = any_below(MOST);
    const bool given = nondet_bool();
    bool due;
    keel_status_t status;

    queue_of(&scheduler.queue, 1u, MOST - 1u);
    any_task(MOST - 1u, nondet_bool());
    narrow_tasks(MOST, 2u, 3u);
    any_state(&scheduler);
    scheduler.config.read_clock = slow_clock;
    scheduler.clock.raw_us = 1u;
    scheduler.clock.now_us = any_bits64(3u);
    scheduler.busy_us = 0u;
    for (uint32_t j = 0u; j < MOST; j++) {
        proof_config[j]->period_us = 8u;
        proof_config[j]->phase_us = any_bits(3u);
        proof_config[j]->run = acting_body;
        proof_config[j]->context = &runs[j];
    }
    due = is_realtime(proof_task[k]) && (scheduler.stage == KEEL_STAGE_READY) &&
          (scheduler.wake_us <= scheduler.clock.now_us) &&
          (proof_task[k]->release_us <= scheduler.clock.now_us);

    status = keel_scheduler_step(given ? &scheduler : NULL);

    assert_scheduler_valid(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_020_null: no scheduler");
    __CPROVER_assert(runs[k] <= 1u, "SCH_019_once: no task runs twice in a step");
    __CPROVER_assert((status != KEEL_OK) || !due || removed[k] || (runs[k] == 1u),
                     "SCH_019_all: no due real-time task is left out");
    __CPROVER_assert((status != KEEL_OK) || (scheduler.stage == KEEL_STAGE_READY),
                     "SCH_019_ready: the step ends between two passes");
}
