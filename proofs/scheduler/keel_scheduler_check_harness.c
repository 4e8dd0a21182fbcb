// cbmc: --unwind 6
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_check admit_queue
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Bounded to a capacity of 4 tasks with periods and budgets up to 2^2 us, as the utilisation
// divides; the contract under WP has no such bound.
#include "../common/admission_proof.h"

void keel_scheduler_check_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    uint32_t admitted = nondet_u32();
    uint32_t offender;
    totals_t totals;
    keel_scheduler_t before;
    keel_status_t expected;
    keel_status_t status;

    any_queue(&scheduler.queue, CAPACITY);
    narrow_tasks(&scheduler.queue, 2u);
    any_state(&scheduler);
    expected = verdict_on_all(&scheduler, &offender, &totals);
    before = scheduler;

    status = keel_scheduler_check(&scheduler, &admitted);

    __CPROVER_assert(status == expected, "SCH_003_complete: the first rule that breaks");
    __CPROVER_assert(admitted == offender, "SCH_003_before: with the first task that breaks it");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_003_frame: nothing is written");
}
