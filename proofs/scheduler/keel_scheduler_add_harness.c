// cbmc: --unwind 6
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_add admit_one_more admit_queue insert
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// After the start, where adding asks for admission; keel_scheduler_add__setup_harness has what
// needs none, at the shipped capacity. Bounded to a capacity of 4 tasks with periods and budgets up
// to 2^2 us, as the utilisation divides; the contract under WP has no such bound.
#include "../common/add_proof.h"
#include "../common/admission_proof.h"

void keel_scheduler_add_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    uint32_t offender;
    totals_t totals;
    keel_scheduler_t before;
    keel_status_t expected;
    keel_status_t status;

    any_queue(&scheduler.queue, CAPACITY);
    narrow_tasks(&scheduler.queue, 2u);
    any_state(&scheduler);
    __CPROVER_assume((scheduler.queue.count < CAPACITY) && (scheduler.stage != KEEL_STAGE_SETUP));
    any_config(&proof_task);
    proof_task.period_us = any_bits(2u) + 1u;
    proof_task.budget_us = any_bits(2u) + 1u;
    __CPROVER_assume(config_is_valid_here(&proof_task));
    expected = verdict_on_all(&scheduler, &offender, &totals);
    if (expected == KEEL_OK) {
        totals = totals_and(totals, proof_task.priority, proof_task.period_us,
                            proof_task.budget_us);
        expected = verdict(&totals, &scheduler.config);
    }
    before = scheduler;

    status = keel_scheduler_add(&scheduler, &proof_task);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert(status == expected, "SCH_005_refused: for the first rule that would break");
    if (status == KEEL_OK) {
        assert_added(&scheduler, &before, i);
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_005_unchanged: a refusal changes nothing");
    }
}
