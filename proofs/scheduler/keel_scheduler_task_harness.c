// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c
// sources: src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/stats.c
// sources: specs/model/scheduler.c specs/model/pass.c specs/model/queue.c specs/model/clock.c
// sources: specs/model/task.c specs/model/decision.c specs/model/priority.c specs/model/stats.c
// sources: specs/model/admission.c specs/model/admission_queue.c
// covers: keel_scheduler_task model_scheduler_task
//
// For any order of the slots.
#include "../../specs/model/scheduler.h"
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_task_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t x = any_below(CAPACITY);
    const uint32_t position = nondet_u32();
    const bool given = nondet_bool();
    const keel_task_config_t *task;
    keel_scheduler_t before;

    any_queue(&scheduler.queue, CAPACITY);
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        scheduler.queue.order[i] = (uint8_t)any_below(CAPACITY);
        __CPROVER_assume((scheduler.queue.task[scheduler.queue.order[i]] != NULL) ==
                         (i < scheduler.queue.count));
    }
    before = scheduler;

    task = keel_scheduler_task(given ? &scheduler : NULL, position);

    __CPROVER_assert(task == model_scheduler_task(given ? &before : NULL, position),
                     "SCH_024_model: as the model says");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_024_frame: nothing is written");
}
