// cbmc: --unwind 34
// sources: src/rtos/scheduler.c src/rtos/pass.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_init config_is_valid
#include "../common/keel_scheduler_proof.h"

keel_scheduler_t nondet_scheduler(void);

void keel_scheduler_init_harness(void)
{
    keel_scheduler_t scheduler = nondet_scheduler();
    keel_scheduler_config_t config;
    const uint32_t x = any_below(CAPACITY);
    const bool given = nondet_bool();
    const bool configured = nondet_bool();
    bool null;
    bool in_range;
    keel_scheduler_t before;
    keel_status_t status;

    config.read_clock = nondet_bool() ? any_clock : NULL;
    config.clock_context = nondet_bool() ? &config : NULL;
    config.guard_us = nondet_u32();
    config.utilisation_limit = nondet_u32();
    null = !given || !configured || (config.read_clock == NULL);
    in_range = (config.guard_us < 0x80000000u) && (config.utilisation_limit <= 1000000u);
    before = scheduler;

    status = keel_scheduler_init(given ? &scheduler : NULL, configured ? &config : NULL);

    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "SCH_002_null: an argument is missing");
    __CPROVER_assert((status == KEEL_ERR_CONFIG) == (!null && !in_range),
                     "SCH_002_config: the guard or the limit is out of range");
    __CPROVER_assert((status == KEEL_OK) == (!null && in_range), "SCH_001_ok: all else is taken");
    if (status == KEEL_OK) {
        ASSERT_SCHEDULER_VALID(&scheduler);
        __CPROVER_assert((scheduler.queue.count == 0u) && (scheduler.queue.task[x] == NULL) &&
                             (scheduler.clock.now_us == 0u) && (scheduler.busy_us == 0u),
                         "SCH_001_empty: no task, no time");
        __CPROVER_assert(setup_same(&scheduler.config, &config), "SCH_001_config: it is copied");
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_SETUP) && (scheduler.wake_us == 0u) &&
                             (scheduler.cursor == 0u) && (scheduler.pass_end == 0u) &&
                             (scheduler.running == KEEL_POSITION_NONE),
                         "SCH_001_stage: not started");
        __CPROVER_assert((scheduler.earliest_realtime_us == 0u) &&
                             (scheduler.earliest_other_us == 0u),
                         "SCH_001_bounds: nothing is known of any release");
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, x),
                         "SCH_002_unchanged: a refusal changes nothing");
    }
}
