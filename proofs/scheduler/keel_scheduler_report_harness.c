// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// sources: specs/model/admission.c specs/model/admission_queue.c
// covers: keel_scheduler_report model_scheduler_report
// defines: -DKEEL_QUEUE_CAPACITY=16u
//
// Bounded to a capacity of 16 tasks, with which the solver comes to an end in seconds; the contract
// under WP has no bound and determines every field.
#include "../../specs/model/scheduler.h"
#include "../common/keel_scheduler_proof.h"

keel_task_report_t nondet_report(void);

static bool report_same(const keel_task_report_t *a, const keel_task_report_t *b)
{
    return (a->release_us == b->release_us) && (a->skipped == b->skipped) &&
           stats_same(&a->stats, &b->stats);
}

void keel_scheduler_report_harness(void)
{
    keel_scheduler_t scheduler;
    keel_task_report_t report = nondet_report();
    keel_task_report_t expected = report;
    const uint32_t x = any_below(CAPACITY);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    const bool wanted = nondet_bool();
    keel_scheduler_t before;
    keel_status_t modelled;
    keel_status_t status;

    any_queue(&scheduler.queue, any_below(CAPACITY + 1u));
    before = scheduler;
    modelled = model_scheduler_report(given ? &before : NULL, task, wanted ? &expected : NULL);

    status = keel_scheduler_report(given ? &scheduler : NULL, task, wanted ? &report : NULL);

    __CPROVER_assert((status == modelled) && report_same(&report, &expected),
                     "SCH_025_model: as the model says");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_025_frame: nothing is written");
}
