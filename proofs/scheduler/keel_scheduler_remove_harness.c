// cbmc: --unwind 34 --external-sat-solver cadical --no-sat-preprocessor
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_remove take_out shift_up
//
// Bounded to queues of at most 3 tasks; that the queue closes its gap is proved for all 32 in
// keel_queue_remove_harness. The preprocessor is the coverage run's, which takes twice as long with
// it; other harnesses' takes longer without.
#include "../common/keel_scheduler_proof.h"

#define MOST 3u

void keel_scheduler_remove_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t j = any_below(MOST);
    const uint32_t t = any_below(MOST);
    const bool given = nondet_bool();
    keel_task_t *task = NULL;
    keel_scheduler_t before;
    keel_task_t task_before;
    bool queued;
    keel_status_t status;

    any_scheduler_of(&scheduler, MOST);
    if (nondet_bool()) {
        task = nondet_bool() ? proof_task[NEWCOMER] : proof_task[t];
    }
    queued = (task != NULL) && (task == proof_task[t]) && (t < scheduler.queue.count);
    before = scheduler;
    task_before = *proof_task[j];

    status = keel_scheduler_remove(given ? &scheduler : NULL, task);

    assert_scheduler_valid(&scheduler);
    __CPROVER_assert((status == KEEL_ERR_NULL) == (!given || (task == NULL)),
                     "SCH_008_null: an argument is missing");
    __CPROVER_assert(!given || (task == NULL) || queued || (status == KEEL_ERR_UNKNOWN_TASK),
                     "SCH_008_unknown: it is not in the queue");
    __CPROVER_assert(!given || !queued || (status == KEEL_OK), "SCH_007_ok: a queued task goes");
    if (status == KEEL_OK) {
        const bool in_pass = (before.cursor <= j) && (j < before.pass_end);
        const uint32_t place = (j > t) ? (j - 1u) : j;

        __CPROVER_assert((i >= scheduler.queue.count) || (scheduler.queue.task[i] != task),
                         "SCH_007_gone: it is queued no more");
        __CPROVER_assert(scheduler.queue.count == (before.queue.count - 1u),
                         "SCH_007_count: one task less");
        __CPROVER_assert(scheduler.wake_us == 0u, "SCH_007_wake: the next step looks anew");
        if ((j != t) && (j < before.queue.count)) {
            __CPROVER_assert(scheduler.queue.task[place] == proof_task[j],
                             "SCH_007_order: the others keep their order");
            __CPROVER_assert(in_pass ==
                                 ((scheduler.cursor <= place) && (place < scheduler.pass_end)),
                             "SCH_006_cursor: the pass still has the same tasks before it");
            __CPROVER_assert((before.running != j) || (scheduler.running == place),
                             "SCH_006_running: the running task is still known");
        }
        __CPROVER_assert((before.running != t) || (scheduler.running == KEEL_INDEX_NONE),
                         "SCH_006_forgotten: a task that removed itself runs no more");
        __CPROVER_assert((before.running != KEEL_INDEX_NONE) ||
                             (scheduler.running == KEEL_INDEX_NONE),
                         "SCH_006_running: with none running, none runs");
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_008_unchanged: a refusal changes nothing");
    }
    __CPROVER_assert((scheduler.stage == before.stage) && (scheduler.busy_us == before.busy_us) &&
                         clock_same(&scheduler.clock, &before.clock) &&
                         task_same(proof_task[j], &task_before),
                     "SCH_007_frame: no task is written, nor the time");
}
