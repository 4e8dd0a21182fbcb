// cbmc: --unwind 34 --unwindset keel_admission_queue.0:4 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_check admit_queue
//
// Bounded to queues of at most 3 tasks with periods and budgets up to 2^3 us, as the utilisation
// divides; the contract under WP has no such bound.
#include "../common/keel_scheduler_proof.h"

#define MOST 3u

void keel_scheduler_check_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(MOST);
    uint32_t admitted = nondet_u32();
    uint64_t demand_us = 0u;
    keel_scheduler_t before;
    keel_task_t task_before;
    keel_status_t status;

    any_scheduler_of(&scheduler, MOST);
    narrow_tasks(MOST, 3u, 5u);
    before = scheduler;
    task_before = *proof_task[t];
    for (uint32_t k = 0u; k < MOST; k++) {
        demand_us += (k < scheduler.queue.realtime_count) ? proof_config[k]->budget_us : 0u;
    }

    status = keel_scheduler_check(&scheduler, &admitted);

    __CPROVER_assert((status == KEEL_OK) == (admitted == scheduler.queue.count),
                     "SCH_003_all: all tasks are admitted, or one is refused");
    __CPROVER_assert(admitted <= scheduler.queue.count, "SCH_003_offender: it is in the queue");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_REALTIME_DEMAND) ||
                         (status == KEEL_ERR_BUDGET_GAP) || (status == KEEL_ERR_UTILISATION),
                     "SCH_003_status: there is no other reason");
    for (uint32_t k = 0u; (status == KEEL_OK) && (k < scheduler.queue.realtime_count); k++) {
        const keel_task_config_t *const config = proof_config[k];

        __CPROVER_assert((demand_us + (2u * (uint64_t)scheduler.config.guard_us)) <=
                             config->period_us,
                         "SCH_003_demand: every real-time period holds all budgets and 2 W");
        __CPROVER_assert((t < scheduler.queue.realtime_count) || (t >= scheduler.queue.count) ||
                             (((uint64_t)proof_config[t]->budget_us + scheduler.config.guard_us +
                               config->budget_us) <= config->period_us),
                         "SCH_003_gaps: every other budget fits every gap");
    }
    __CPROVER_assert(scheduler_same(&scheduler, &before, i) &&
                         task_same(proof_task[t], &task_before),
                     "SCH_003_frame: nothing changed");
}
