// cbmc: --unwind 6
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_add admit_one_more admit_queue insert
// defines: -DKEEL_QUEUE_CAPACITY=4u
//
// Any arguments, at any stage. Bounded to a capacity of 4 tasks, and to valid periods and budgets
// up to 2^2 us, as the utilisation divides; the contract under WP has no such bound.
#include "../common/add_proof.h"
#include "../common/admission_proof.h"

/* Any declaration; where period and budget are valid they are small. */
static void any_newcomer(void)
{
    any_config(&proof_task);
    proof_task.period_us = any_bits(2u) + 1u;
    if (nondet_bool()) {
        proof_task.period_us = nondet_bool() ? 0u : KEEL_PERIOD_LIMIT_US;
    }
    proof_task.budget_us = any_bits(2u);
}

/* What adding the newcomer, which stands at a place in the queue if that is within it, answers. */
static keel_status_t answer(const keel_scheduler_t *scheduler, uint32_t place)
{
    uint32_t offender;
    totals_t totals;
    keel_status_t status;

    if (place < scheduler->queue.count) {
        return KEEL_ERR_DUPLICATE;
    }
    if (scheduler->queue.count == CAPACITY) {
        return KEEL_ERR_FULL;
    }
    if (scheduler->stage == KEEL_STAGE_SETUP) {
        return KEEL_OK;
    }
    status = verdict_on_all(scheduler, &offender, &totals);
    if (status != KEEL_OK) {
        return status;
    }
    totals = totals_and(totals, proof_task.priority, proof_task.period_us, proof_task.budget_us);
    return verdict(&totals, &scheduler->config);
}

void keel_scheduler_add_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t place = any_below(CAPACITY + 1u);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    bool null;
    bool valid;
    keel_scheduler_t before;
    keel_task_config_t task_before;
    keel_status_t status;

    any_queue(&scheduler.queue, place);
    narrow_tasks(&scheduler.queue, 2u);
    any_state(&scheduler);
    any_newcomer();
    null = !given || (task == NULL) || (proof_task.run == NULL);
    valid = config_is_valid_here(&proof_task);
    before = scheduler;
    task_before = proof_task;

    status = keel_scheduler_add(given ? &scheduler : NULL, task);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "SCH_005_null: an argument is missing");
    __CPROVER_assert(null || valid || (status == keel_task_check(&proof_task)),
                     "SCH_005_checked: refused for the reason that the check names");
    __CPROVER_assert(null || !valid || (status == answer(&before, place)),
                     "SCH_005_refused: queued, no slot left, or the rule that would break");
    if (status == KEEL_OK) {
        assert_added(&scheduler, &before, i);
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_005_unchanged: a refusal changes nothing");
    }
    __CPROVER_assert(config_same(&proof_task, &task_before),
                     "SCH_004_frame: the declaration is not written");
}
