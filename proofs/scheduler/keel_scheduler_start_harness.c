// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_admission_queue
// covers: keel_scheduler_start admit_queue read_clock model_scheduler_start
#include "scheduler_parts.h"

void keel_scheduler_start_harness(void)
{
    const bool given = nondet_bool();
    keel_status_t modelled;
    keel_status_t status;

    at = any_below(CAPACITY);
    any_parts(CAPACITY);
    modelled = model_scheduler_start(given ? &expected : NULL);
    read_again();

    status = keel_scheduler_start(given ? &scheduler : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, at) &&
                         is_read_as_often(),
                     "SCH_009_model: as the model says");
}
