// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_add insert
//
// Before the start, where adding asks for no admission; with all numbers of their full width. The
// task stands in the queue already, or does not, and its declaration is any.
#include "../common/add_proof.h"

void keel_scheduler_add__setup_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t place = any_below(CAPACITY + 1u);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    bool null;
    bool valid;
    bool queued;
    bool full;
    keel_scheduler_t before;
    keel_task_config_t task_before;
    keel_status_t status;

    any_scheduler(&scheduler, place);
    scheduler.stage = KEEL_STAGE_SETUP;
    any_config(&proof_task);
    null = !given || (task == NULL) || (proof_task.run == NULL);
    valid = config_is_valid_here(&proof_task);
    queued = place < scheduler.queue.count;
    full = scheduler.queue.count == CAPACITY;
    before = scheduler;
    task_before = proof_task;

    status = keel_scheduler_add(given ? &scheduler : NULL, task);

    ASSERT_SCHEDULER_VALID(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "SCH_005_null: an argument is missing");
    __CPROVER_assert(null || valid || (status == keel_task_check(&proof_task)),
                     "SCH_005_checked: refused for the reason that the check names");
    __CPROVER_assert((status == KEEL_ERR_DUPLICATE) == (!null && valid && queued),
                     "SCH_005_duplicate: queued already");
    __CPROVER_assert((status == KEEL_ERR_FULL) == (!null && valid && !queued && full),
                     "SCH_005_full: no slot is left");
    __CPROVER_assert((status == KEEL_OK) == (!null && valid && !queued && !full),
                     "SCH_004_setup: before the start any other valid task is taken");
    if (status == KEEL_OK) {
        assert_added(&scheduler, &before, i);
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_005_unchanged: a refusal changes nothing");
    }
    __CPROVER_assert(config_same(&proof_task, &task_before),
                     "SCH_004_frame: the declaration is not written");
}
