// cbmc: --unwind 34 --unwindset keel_admission_queue.0:4 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_start keel_scheduler_start_at read_clock
//
// Bounded to queues of at most 3 tasks with periods and budgets up to 2^2 us, as the utilisation
// divides; the contract under WP has no such bound.
#include "../common/keel_scheduler_proof.h"

#define MOST 3u

void keel_scheduler_start_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(MOST);
    const bool given = nondet_bool();
    keel_scheduler_t before;
    keel_task_t task_before;
    keel_status_t status;

    any_scheduler_of(&scheduler, MOST);
    narrow_tasks(MOST, 2u, 5u);
    wait_for_the_start(&scheduler, MOST);
    before = scheduler;
    task_before = *proof_task[t];

    status = keel_scheduler_start(given ? &scheduler : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == !given, "SCH_019_null: no scheduler");
    __CPROVER_assert(!given || ((status == KEEL_ERR_STATE) == (before.stage != KEEL_STAGE_SETUP)),
                     "SCH_010_state: it was started before");
    if (status == KEEL_OK) {
        assert_scheduler_valid(&scheduler);
        __CPROVER_assert(scheduler.stage == KEEL_STAGE_READY, "SCH_009_stage: it is started");
        __CPROVER_assert((scheduler.clock.now_us == 0u) &&
                             (scheduler.clock.raw_us == clock_reading),
                         "SCH_009_clock: time begins at 0 with this reading");
        __CPROVER_assert((t >= scheduler.queue.count) ||
                             (proof_task[t]->release_us == proof_config[t]->phase_us),
                         "SCH_009_release: every first release is the phase");
        __CPROVER_assert((t >= scheduler.queue.realtime_count) ||
                             ((proof_config[t]->budget_us +
                               (2u * (uint64_t)scheduler.config.guard_us)) <=
                              proof_config[t]->period_us),
                         "SCH_009_admitted: every real-time period holds its budget and 2 W");
        __CPROVER_assert(queue_same(&scheduler.queue, &before.queue, i), "SCH_009_queue: it stays");
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i) &&
                             task_same(proof_task[t], &task_before),
                         "SCH_010_kept: a refusal changes nothing");
    }
}
