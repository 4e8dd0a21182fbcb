// cbmc: --unwind 3 --unwindset is_known.0:9,is_known_realtime.0:9
// cbmc: --external-sat-solver cadical --no-sat-preprocessor
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_run_pass read_clock
// defines: -DKEEL_QUEUE_CAPACITY=2u
//
// Bounded to a queue of a real-time task and another, each of which may remove any task as it
// runs, itself included; to a pass as begin opens it, or none; to periods of 8 us, budgets and runs
// up to 2^2 us and times below 2^3 us at the start. A pass over more tasks, or with bodies that add
// tasks, does not come to an end: that an addition keeps the pass is proved in
// keel_scheduler_add_harness. The preprocessor is the coverage run's, which takes four times as
// long with it.
#include "../common/keel_scheduler_proof.h"

#define REALTIME 1u
#define MOST     2u

static keel_scheduler_t scheduler;
static uint32_t runs[MOST];
static bool removed[MOST];
static uint32_t next_realtime; /* One more than the last real-time task that ran. */

static void acting_body(void *context)
{
    const uint32_t k = (uint32_t)((uint32_t *)context - runs);
    const uint32_t victim = any_below(MOST);

    runs[k]++;
    __CPROVER_assert(!removed[k], "SCH_023_removed: a task that was removed does not run");
    if (k < REALTIME) {
        __CPROVER_assert(next_realtime <= k, "SCH_023_order: real-time tasks run in queue order");
        next_realtime = k + 1u;
    }
    if (nondet_bool() && (keel_scheduler_remove(&scheduler, proof_task[victim]) == KEEL_OK)) {
        removed[victim] = true;
    }
}

/* Moves on by a little, or breaks. */
static uint32_t slow_clock(void *context)
{
    static uint32_t reading = 1u;

    (void)context;
    reading = nondet_bool() ? (reading + any_bits(2u)) : 0u;
    return reading;
}

void keel_scheduler_run_pass_harness(void)
{
    const uint32_t k = any_below(MOST);
    bool is_open;
    bool due;
    keel_status_t status;

    queue_of(&scheduler.queue, REALTIME, MOST);
    narrow_tasks(MOST, 2u, 3u);
    any_state(&scheduler);
    __CPROVER_assume((scheduler.stage == KEEL_STAGE_READY) || (scheduler.stage == KEEL_STAGE_PASS));
    scheduler.cursor = 0u;
    scheduler.pass_end = REALTIME;
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
    is_open = scheduler.stage == KEEL_STAGE_PASS;
    due = is_open && (scheduler.cursor <= k) && (k < scheduler.pass_end) &&
          (proof_task[k]->release_us <= scheduler.clock.now_us);

    status = keel_scheduler_run_pass(&scheduler);

    assert_scheduler_valid(&scheduler);
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_CLOCK),
                     "SCH_023_result: of the clock alone");
    __CPROVER_assert(runs[k] <= 1u, "SCH_023_once: no task runs twice in a pass");
    __CPROVER_assert(is_open || (runs[k] == 0u), "SCH_023_open: none runs without a pass");
    __CPROVER_assert((status != KEEL_OK) || !due || removed[k] || (runs[k] == 1u),
                     "SCH_023_all: no due real-time task that is left is left out");
    __CPROVER_assert(!is_open || (scheduler.stage == KEEL_STAGE_READY),
                     "SCH_023_closed: the pass is closed");
}
