// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_resync read_clock
//
// Bounded to queues of at most 1 task: the function never looks at one.
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_resync_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const bool given = nondet_bool();
    keel_scheduler_t before;
    keel_status_t status;

    any_scheduler_of(&scheduler, 1u);
    before = scheduler;

    status = keel_scheduler_resync(given ? &scheduler : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_021_null: no scheduler");
    __CPROVER_assert(!given || ((status == KEEL_ERR_STATE) == (before.stage != KEEL_STAGE_READY)),
                     "SCH_021_state: only between two passes");
    if (status == KEEL_OK) {
        __CPROVER_assert(scheduler.clock.raw_us == clock_reading,
                         "SCH_021_adopted: the clock's reading is adopted");
        before.clock.raw_us = clock_reading;
    }
    __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                     "SCH_021_frame: nothing else changes, above all not the time");
}
