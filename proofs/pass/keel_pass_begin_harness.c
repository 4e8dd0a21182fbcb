// cbmc: --unwind 34
// sources: src/rtos/pass.c src/rtos/queue.c src/rtos/decision.c src/rtos/priority.c src/rtos/load.c
// covers: keel_pass_begin
//
// All that beginning writes, and when. That a step which opens no pass leaves nothing due
// (SCH_011_idle) and the wake-up time right (SCH_012_wake) is WP's alone: it multiplies priorities
// and ages, with which the solver does not come to an end.
#include "../common/keel_scheduler_proof.h"

void keel_pass_begin_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t raw_us = nondet_u32();
    uint64_t step_us;
    keel_scheduler_t before;
    keel_scheduler_t expected;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    step_us = elapsed(scheduler.clock.raw_us, raw_us);
    before = scheduler;
    expected = scheduler;

    status = keel_pass_begin(&scheduler, raw_us);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_STATE) == (before.stage != KEEL_STAGE_READY),
                     "SCH_013_state: not started, or in a pass");
    __CPROVER_assert((status == KEEL_ERR_CLOCK) ==
                         ((before.stage == KEEL_STAGE_READY) && (step_us >= 0x80000000u)),
                     "SCH_013_clock: the clock jumped backwards");
    if ((before.stage == KEEL_STAGE_READY) && (step_us < 0x80000000u)) {
        __CPROVER_assert(status == KEEL_OK, "SCH_011_ok: else it is done");
        expected.clock.now_us += step_us;
        expected.clock.raw_us = raw_us;
        __CPROVER_assert(clock_same(&scheduler.clock, &expected.clock),
                         "SCH_011_time: time moves on to the reading");
        if (expected.clock.now_us >= before.wake_us) {
            expected.stage = KEEL_STAGE_PASS;
            expected.wake_us = 0u;
            expected.cursor = 0;
            expected.pass_end = (int16_t)before.queue.realtime_count;
        }
    }
    __CPROVER_assert(
        scheduler_same(&scheduler, &expected, i),
        "SCH_011_open: a pass over all real-time tasks opens from the wake-up time on, "
        "and nothing else is written");
}
