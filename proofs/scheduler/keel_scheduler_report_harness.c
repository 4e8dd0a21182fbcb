// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_report
#include "../common/keel_scheduler_proof.h"

keel_task_report_t nondet_report(void);

void keel_scheduler_report_harness(void)
{
    keel_scheduler_t scheduler;
    keel_task_report_t report = nondet_report();
    const keel_task_report_t report_before = report;
    const uint32_t x = any_below(CAPACITY);
    const uint32_t place = any_below(CAPACITY + 1u);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    const bool wanted = nondet_bool();
    bool null;
    bool known;
    keel_scheduler_t before;
    keel_status_t status;

    any_queue(&scheduler.queue, place);
    null = !given || !wanted || (task == NULL);
    known = place < scheduler.queue.count;
    before = scheduler;

    status = keel_scheduler_report(given ? &scheduler : NULL, task, wanted ? &report : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "SCH_025_null: an argument is missing");
    __CPROVER_assert((status == KEEL_ERR_UNKNOWN_TASK) == (!null && !known),
                     "SCH_025_unknown: it is not in the queue");
    __CPROVER_assert((status == KEEL_OK) == (!null && known), "SCH_025_ok: else it is known");
    if (status == KEEL_OK) {
        const uint32_t slot = before.queue.order[place];

        __CPROVER_assert((report.release_us == before.queue.release_us[slot]) &&
                             (report.skipped == before.queue.skipped[slot]) &&
                             stats_same(&report.stats, &before.queue.stats[slot]),
                         "SCH_025_report: all is the task's own");
    } else {
        __CPROVER_assert((report.release_us == report_before.release_us) &&
                             (report.skipped == report_before.skipped) &&
                             stats_same(&report.stats, &report_before.stats),
                         "SCH_025_unchanged: a refusal leaves the report as it is");
    }
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_025_frame: nothing is written");
}
