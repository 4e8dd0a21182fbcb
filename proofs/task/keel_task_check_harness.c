// cbmc: --unwind 34
// sources: src/rtos/task.c
// covers: keel_task_check priority_is_valid
#include "../common/keel_proof.h"

static bool priority_ok(uint32_t priority)
{
    return (priority == 1u) || (priority == 2u) || (priority == 3u) || (priority == 4u) ||
           (priority == 16u);
}

void keel_task_check_harness(void)
{
    keel_task_config_t config = nondet_config();
    const keel_task_config_t *const given = nondet_bool() ? &config : NULL;
    bool null;
    bool period_ok;
    bool phase_ok;
    keel_status_t status;
    keel_task_config_t before;

    config.run = nondet_bool() ? idle_body : NULL;
    config.context = NULL;
    config.name = NULL;
    before = config;
    null = (given == NULL) || (config.run == NULL);
    period_ok = (0u < config.period_us) && (config.period_us <= 0x7FFFFFFFu);
    phase_ok = period_ok && (config.phase_us < config.period_us);

    status = keel_task_check(given);

    __CPROVER_assert((status == KEEL_ERR_NULL) == null, "TSK_002_null: no declaration or no body");
    __CPROVER_assert(null || ((status == KEEL_ERR_PERIOD) == !period_ok),
                     "TSK_002_period: the period is 0 or 2^31 or more");
    __CPROVER_assert(null || !period_ok || ((status == KEEL_ERR_PHASE) == !phase_ok),
                     "TSK_002_phase: the phase is not below the period");
    __CPROVER_assert(null || !phase_ok ||
                         ((status == KEEL_ERR_BUDGET_ZERO) == (config.budget_us == 0u)),
                     "TSK_002_budget: the budget is 0");
    __CPROVER_assert(null || !phase_ok || (config.budget_us == 0u) ||
                         ((status == KEEL_ERR_PRIORITY) == !priority_ok(config.priority)),
                     "TSK_002_priority: the priority is none of the five");
    __CPROVER_assert((status == KEEL_OK) == (!null && phase_ok && (config.budget_us > 0u) &&
                                             priority_ok(config.priority)),
                     "TSK_002_valid: all else is accepted");
    __CPROVER_assert(config_same(&config, &before),
                     "TSK_002_frame: the declaration is not written");
}
