// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_init config_is_valid
#include "../common/keel_scheduler_proof.h"

void keel_scheduler_init_harness(void)
{
    keel_scheduler_t scheduler;
    keel_scheduler_config_t config;
    const uint32_t i = any_below(CAPACITY);
    const bool given = nondet_bool();
    const bool configured = nondet_bool();
    bool null;
    bool in_range;
    keel_scheduler_t before;
    keel_status_t status;

    any_scheduler_of(&scheduler, 1u);
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
        __CPROVER_assert((scheduler.queue.realtime_count == 0u) &&
                             (scheduler.queue.task[i] == NULL),
                         "SCH_001_valid: an empty queue without gaps");
        __CPROVER_assert((scheduler.queue.count == 0u) && (scheduler.clock.now_us == 0u) &&
                             (scheduler.busy_us == 0u),
                         "SCH_001_empty: no task, no time");
        __CPROVER_assert(setup_same(&scheduler.config, &config), "SCH_001_config: it is copied");
        __CPROVER_assert((scheduler.stage == KEEL_STAGE_SETUP) && (scheduler.wake_us == 0u) &&
                             (scheduler.cursor == 0u) && (scheduler.pass_end == 0u) &&
                             (scheduler.running == KEEL_INDEX_NONE) && !scheduler.ran,
                         "SCH_001_stage: not started");
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i),
                         "SCH_002_unchanged: a refusal changes nothing");
    }
}
