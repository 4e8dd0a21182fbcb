// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// replaces: keel_admission_queue
// covers: keel_scheduler_check admit_queue model_scheduler_check admit_all
#include "scheduler_parts.h"

void keel_scheduler_check_harness(void)
{
    uint32_t admitted = nondet_u32();
    uint32_t expected_admitted = admitted;
    keel_status_t modelled;
    keel_status_t status;

    at = any_below(CAPACITY);
    any_parts(CAPACITY);
    modelled = model_scheduler_check(&expected, &expected_admitted);

    status = keel_scheduler_check(&scheduler, &admitted);

    __CPROVER_assert((status == modelled) && (admitted == expected_admitted) &&
                         scheduler_same(&scheduler, &expected, at),
                     "SCH_003_model: as the model says");
}
