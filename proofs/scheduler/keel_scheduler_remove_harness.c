// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_queue_remove
// defines: -DKEEL_QUEUE_CAPACITY=16u
// covers: keel_scheduler_remove remove_task shift_pass model_scheduler_remove
//
// Bounded to a capacity of 16 tasks, with which the solver comes to an end in half a minute; the
// contract under WP has no bound and determines every field.
#include "scheduler_parts.h"

void keel_scheduler_remove_harness(void)
{
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    const bool given = nondet_bool();
    keel_status_t modelled;
    keel_status_t status;

    at = any_below(CAPACITY);
    any_parts(any_below(CAPACITY + 1u));
    modelled = model_scheduler_remove(given ? &expected : NULL, task);

    status = keel_scheduler_remove(given ? &scheduler : NULL, task);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, at),
                     "SCH_007_model: as the model says");
    __CPROVER_assert((scheduler.pass_end - scheduler.cursor) <= (before.pass_end - before.cursor),
                     "SCH_007_shrinks: the pass gets no longer");
}
