// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_finish
//
// Bounded to queues of at most 3 tasks, of which it touches one.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

#define MOST 3u

void keel_scheduler_finish_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(MOST);
    const uint32_t raw_us = nondet_u32();
    uint64_t step_us;
    keel_scheduler_t before;
    keel_task_t task_before;
    bool running;
    keel_status_t status;

    any_scheduler_of(&scheduler, MOST);
    step_us = ((raw_us >= scheduler.clock.raw_us) ? 0u : 0x100000000u) + (uint64_t)raw_us -
              scheduler.clock.raw_us;
    running = (scheduler.stage == KEEL_STAGE_REALTIME) || (scheduler.stage == KEEL_STAGE_OTHER);
    before = scheduler;
    task_before = *proof_task[t];

    __CPROVER_assume(keel_scheduler_finish_may(&scheduler));
    status = keel_scheduler_finish(&scheduler, raw_us);

    __CPROVER_assert(keel_scheduler_finish_does(status, &before, &scheduler),
                     "SCH_020_part: as the step takes it to do");

    assert_scheduler_valid(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_STATE) == !running, "SCH_018_state: no task runs");
    __CPROVER_assert((status == KEEL_ERR_CLOCK) == (running && (step_us >= 0x80000000u)),
                     "SCH_018_clock: the clock jumped backwards");
    if (status == KEEL_ERR_STATE) {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_018_kept: a refusal changes nothing");
    }
    if (status == KEEL_ERR_CLOCK) {
        __CPROVER_assert(clock_same(&scheduler.clock, &before.clock) &&
                             (scheduler.busy_us == before.busy_us),
                         "SCH_018_time: the time stays");
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_READY) &&
                             (scheduler.running == KEEL_INDEX_NONE),
                         "SCH_018_ends: the pass ends");
    }
    if (status == KEEL_OK) {
        __CPROVER_assert((scheduler.clock.now_us == (before.clock.now_us + step_us)) &&
                             (scheduler.clock.raw_us == raw_us),
                         "SCH_017_time: time moves on to the reading");
        __CPROVER_assert((scheduler.busy_us == (before.busy_us + step_us)) &&
                             (scheduler.busy_us <= scheduler.clock.now_us),
                         "SCH_017_busy: the run was busy time");
        __CPROVER_assert(scheduler.stage == ((before.stage == KEEL_STAGE_REALTIME)
                                                 ? KEEL_STAGE_PASS
                                                 : KEEL_STAGE_READY),
                         "SCH_017_stage: the pass goes on after a real-time task");
        __CPROVER_assert(scheduler.running == KEEL_INDEX_NONE, "SCH_017_running: none runs");
    }
    if ((status == KEEL_OK) && (t == before.running)) {
        __CPROVER_assert((proof_task[t]->stats.last_us == step_us) &&
                             (proof_task[t]->stats.longest_us >= step_us) &&
                             (proof_task[t]->stats.longest_us >= task_before.stats.longest_us),
                         "SCH_017_recorded: the run is in the task's statistics");
    } else {
        __CPROVER_assert(task_same(proof_task[t], &task_before),
                         "SCH_017_others: no other task is written");
    }
    __CPROVER_assert(queue_same(&scheduler.queue, &before.queue, i) &&
                         (scheduler.wake_us == before.wake_us) &&
                         (scheduler.cursor == before.cursor) &&
                         (scheduler.pass_end == before.pass_end) && (scheduler.ran == before.ran),
                     "SCH_017_frame: queue and pass stay");
}
