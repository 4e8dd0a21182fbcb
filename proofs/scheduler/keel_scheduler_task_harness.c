// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_task
//
// For any order of the slots.
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

    __CPROVER_assert((task == NULL) == (!given || (position >= scheduler.queue.count)),
                     "SCH_024_none: no scheduler, or no task at this position");
    __CPROVER_assert((task == NULL) ||
                         (task == scheduler.queue.task[scheduler.queue.order[position]]),
                     "SCH_024_task: it is the task at this position");
    __CPROVER_assert(scheduler_same(&scheduler, &before, x), "SCH_024_frame: nothing is written");
}
