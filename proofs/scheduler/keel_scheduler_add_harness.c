// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_admission_queue keel_admission_admit keel_queue_add
// defines: -DKEEL_QUEUE_CAPACITY=8u
// covers: keel_scheduler_add admit_one_more admit_queue insert_task add_to_queue
// covers: model_scheduler_add refusal_of
//
// Any arguments, at any stage. Bounded to a capacity of 8 tasks, with which the solver comes to an
// end in half a minute; the contract under WP has no bound and determines every field.
#include "scheduler_parts.h"

void keel_scheduler_add_harness(void)
{
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    keel_task_config_t declared;
    keel_status_t modelled;
    keel_status_t status;

    any_config(&proof_task);
    declared = proof_task;
    at = any_below(CAPACITY);
    any_parts(any_below(CAPACITY + 1u));
    modelled = model_scheduler_add(given ? &expected : NULL, task);

    status = keel_scheduler_add(given ? &scheduler : NULL, task);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, at),
                     "SCH_004_model: as the model says");
    __CPROVER_assert(config_same(&proof_task, &declared), "SCH_004_frame: the declaration stays");
}
