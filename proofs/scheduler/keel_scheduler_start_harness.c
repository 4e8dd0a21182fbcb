// cbmc: --unwind 6
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_start keel_scheduler_start_at read_clock
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a capacity of 4 tasks with periods and budgets up to 2^2 us, as the utilisation
// divides; the contract under WP has no such bound.
#include "../common/admission_proof.h"

void keel_scheduler_start_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    uint32_t offender;
    totals_t totals;
    keel_scheduler_t expected;
    keel_status_t refusal;
    keel_status_t status;

    any_queue(&scheduler.queue, CAPACITY);
    narrow_tasks(&scheduler.queue, 2u);
    any_state(&scheduler);
    refusal = verdict_on_all(&scheduler, &offender, &totals);
    expected = scheduler;

    status = keel_scheduler_start(given ? &scheduler : NULL);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_019_null: no scheduler");
    __CPROVER_assert((status == KEEL_ERR_STATE) == (given && (expected.stage != KEEL_STAGE_SETUP)),
                     "SCH_019_state: it was started before");
    __CPROVER_assert(!given || (status == KEEL_ERR_STATE) || (status == refusal),
                     "SCH_019_refused: for the first rule that breaks");
    if (status == KEEL_OK) {
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_READY) && (scheduler.clock.now_us == 0u),
                         "SCH_019_stage: it is started, at time 0");
        __CPROVER_assert((clock_readings == 1u) && (scheduler.clock.raw_us == clock_reading),
                         "SCH_019_clock: with the clock's reading");
        expected.stage = KEEL_STAGE_READY;
        expected.clock.now_us = 0u;
        expected.clock.raw_us = clock_reading;
        expected.earliest_realtime_us = 0u;
    }
    __CPROVER_assert(scheduler_same(&scheduler, &expected, x),
                     "SCH_019_frame: nothing else is written, and nothing at all by a refusal");
}
