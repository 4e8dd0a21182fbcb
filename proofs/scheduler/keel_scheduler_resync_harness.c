// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_resync read_clock
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_resync_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    keel_scheduler_t expected;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    expected = scheduler;

    status = keel_scheduler_resync(given ? &scheduler : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_021_null: no scheduler");
    __CPROVER_assert((status == KEEL_ERR_STATE) == (given && (expected.stage != KEEL_STAGE_READY)),
                     "SCH_021_state: only between two passes");
    if (given && (expected.stage == KEEL_STAGE_READY)) {
        __CPROVER_assert((status == KEEL_OK) && (clock_readings == 1u),
                         "SCH_021_taken: the clock is read");
        expected.clock.raw_us = clock_reading;
    }
    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert(scheduler_same(&scheduler, &expected, x),
                     "SCH_021_frame: its reading is taken, nothing else is written, above all not "
                     "the time");
}
