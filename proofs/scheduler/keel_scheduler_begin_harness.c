// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_begin keel_clock_advance
//
// Bounded to queues of at most 2 tasks: the function never looks at one.
#include "../common/keel_scheduler_proof.h"
#include "../common/step_contracts.h"

#define MOST 2u

void keel_scheduler_begin_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(MOST);
    const uint32_t raw_us = nondet_u32();
    uint64_t step_us;
    keel_scheduler_t before;
    keel_task_t task_before;
    keel_status_t status;

    any_scheduler_of(&scheduler, MOST);
    step_us = ((raw_us >= scheduler.clock.raw_us) ? 0u : 0x100000000u) + (uint64_t)raw_us -
              scheduler.clock.raw_us;
    before = scheduler;
    task_before = *proof_task[t];

    __CPROVER_assume(keel_scheduler_begin_may(&scheduler));
    status = keel_scheduler_begin(&scheduler, raw_us);

    __CPROVER_assert(keel_scheduler_begin_does(status, &before, &scheduler),
                     "SCH_020_part: as the step takes it to do");

    assert_scheduler_valid(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_STATE) == (before.stage != KEEL_STAGE_READY),
                     "SCH_013_state: not started, or in a pass");
    __CPROVER_assert((status == KEEL_ERR_CLOCK) ==
                         ((before.stage == KEEL_STAGE_READY) && (step_us >= 0x80000000u)),
                     "SCH_013_clock: the clock jumped backwards");
    if (status == KEEL_OK) {
        __CPROVER_assert((scheduler.clock.now_us == (before.clock.now_us + step_us)) &&
                             (scheduler.clock.raw_us == raw_us),
                         "SCH_011_time: time moves on to the reading");
        if (scheduler.clock.now_us < before.wake_us) {
            __CPROVER_assert((scheduler.stage == KEEL_STAGE_READY) &&
                                 (scheduler.wake_us == before.wake_us),
                             "SCH_011_idle: before the wake-up time only the clock is read");
        } else {
            __CPROVER_assert((scheduler.stage == KEEL_STAGE_PASS) && (scheduler.cursor == 0u) &&
                                 (scheduler.pass_end == scheduler.queue.realtime_count) &&
                                 !scheduler.ran && (scheduler.wake_us == 0u),
                             "SCH_011_open: from it on a pass over all real-time tasks opens");
        }
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_013_kept: a refusal changes nothing");
    }
    __CPROVER_assert(queue_same(&scheduler.queue, &before.queue, i) &&
                         task_same(proof_task[t], &task_before) &&
                         (scheduler.busy_us == before.busy_us) &&
                         (scheduler.running == before.running),
                     "SCH_011_frame: no task is touched");
}
