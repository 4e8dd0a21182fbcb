// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// sources: specs/model/admission.c specs/model/admission_queue.c
// covers: keel_scheduler_resync read_clock model_scheduler_resync
#include "../../specs/model/scheduler.h"
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_resync_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    keel_scheduler_t expected;
    keel_status_t modelled;
    keel_status_t status;

    any_scheduler(&scheduler, CAPACITY);
    expected = scheduler;
    modelled = model_scheduler_resync(given ? &expected : NULL);
    read_again();

    status = keel_scheduler_resync(given ? &scheduler : NULL);

    __CPROVER_assert((status == modelled) && scheduler_same(&scheduler, &expected, x) &&
                         is_read_as_often(),
                     "SCH_021_model: as the model says");
}
