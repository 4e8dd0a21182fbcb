// cbmc: --unwind 34 --unwindset keel_admission_queue.0:3,open_slot.0:3 --external-sat-solver cadical
// sources: src/rtos/scheduler.c src/rtos/queue.c src/rtos/task.c src/rtos/decision.c src/rtos/priority.c src/rtos/admission.c src/rtos/load.c
// covers: keel_scheduler_add admit_one_more insert enqueue
//
// Bounded to queues of at most 2 tasks, or full ones; periods and budgets up to 2^2 us, as the
// utilisation divides. The contract under WP has no such bound.
#include "../common/keel_scheduler_proof.h"

#define MOST 2u

/* Whether real-time tasks' periods hold all their budgets and 2 W (ADM-004). */
static bool periods_hold(const keel_scheduler_t *scheduler)
{
    uint64_t demand_us = 2u * (uint64_t)scheduler->config.guard_us;
    bool hold = true;

    for (uint32_t j = 0u; j <= MOST; j++) {
        if (j < scheduler->queue.realtime_count) {
            demand_us += scheduler->queue.task[j]->config->budget_us;
        }
    }
    for (uint32_t j = 0u; j <= MOST; j++) {
        hold = hold && ((j >= scheduler->queue.realtime_count) ||
                        (demand_us <= scheduler->queue.task[j]->config->period_us));
    }
    return hold;
}

/* Whether every other budget and W fit the time that each real-time task leaves (ADM-004). */
static bool budgets_fit(const keel_scheduler_t *scheduler)
{
    bool fit = true;

    for (uint32_t r = 0u; r <= MOST; r++) {
        for (uint32_t o = 0u; o <= MOST; o++) {
            if ((r < scheduler->queue.realtime_count) && (scheduler->queue.realtime_count <= o) &&
                (o < scheduler->queue.count)) {
                const keel_task_config_t *const realtime = scheduler->queue.task[r]->config;
                const keel_task_config_t *const other = scheduler->queue.task[o]->config;

                fit = fit && (((uint64_t)other->budget_us + scheduler->config.guard_us +
                               realtime->budget_us) <= realtime->period_us);
            }
        }
    }
    return fit;
}

void keel_scheduler_add_harness(void)
{
    keel_scheduler_t scheduler;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(MOST);
    const bool given = nondet_bool();
    keel_task_t *task = NULL;
    keel_scheduler_t before;
    keel_task_t task_before;
    keel_task_t newcomer_before;
    bool valid;
    bool queued;
    uint32_t place;
    keel_status_t status;

    any_queue(&scheduler.queue);
    __CPROVER_assume((scheduler.queue.count <= MOST) || (scheduler.queue.count == CAPACITY));
    narrow_tasks(MOST, 2u, 5u);
    if (nondet_bool()) {
        /* The declaration is any: it is checked here. */
        any_config(proof_config[NEWCOMER], nondet_bool());
        proof_config[NEWCOMER]->run = nondet_bool() ? idle_body : NULL;
        proof_config[NEWCOMER]->period_us = any_bits(2u);
        proof_config[NEWCOMER]->budget_us = any_bits(2u);
    }
    any_state(&scheduler);
    if (nondet_bool()) {
        proof_task[NEWCOMER]->config = NULL;
    }
    if (nondet_bool()) {
        task = nondet_bool() ? proof_task[NEWCOMER] : proof_task[t];
    }
    queued = (task != NULL) && (task == proof_task[t]) && (t < scheduler.queue.count);
    valid = (task == proof_task[t]) || ((proof_task[NEWCOMER]->config != NULL) &&
                                        config_is_valid_here(proof_config[NEWCOMER]));
    before = scheduler;
    task_before = *proof_task[t];
    newcomer_before = *proof_task[NEWCOMER];
    place = ((task != NULL) && (task->config != NULL) && is_realtime(task))
                ? scheduler.queue.realtime_count
                : scheduler.queue.count;

    status = keel_scheduler_add(given ? &scheduler : NULL, task);

    assert_scheduler_valid(&scheduler);
    if (!given || (task == NULL)) {
        __CPROVER_assert(status == KEEL_ERR_NULL, "SCH_005_null: an argument is missing");
    } else {
        __CPROVER_assert((status != KEEL_OK) || valid, "SCH_005_checked: only a valid declaration");
        __CPROVER_assert(valid || (status == keel_task_check(task->config)),
                         "SCH_005_checked: refused for the reason that the check names");
        __CPROVER_assert(!queued || !valid || (status == KEEL_ERR_DUPLICATE),
                         "SCH_005_duplicate: queued already");
        __CPROVER_assert(queued || !valid || (before.queue.count < CAPACITY) ||
                             (status == KEEL_ERR_FULL),
                         "SCH_005_full: no slot is left");
        __CPROVER_assert(queued || !valid || (before.queue.count == CAPACITY) ||
                             (before.stage != KEEL_STAGE_SETUP) || (status == KEEL_OK),
                         "SCH_004_setup: before the start a valid task is taken");
        __CPROVER_assert(queued || !valid || (before.queue.count == CAPACITY) ||
                             (status == KEEL_OK) || (status == KEEL_ERR_REALTIME_DEMAND) ||
                             (status == KEEL_ERR_BUDGET_GAP) || (status == KEEL_ERR_UTILISATION),
                         "SCH_004_status: afterwards only admission may refuse it");
    }
    if (status == KEEL_OK) {
        __CPROVER_assert(scheduler.queue.count == (before.queue.count + 1u),
                         "SCH_004_count: one task more");
        __CPROVER_assert(scheduler.queue.task[place] == task, "SCH_004_place: last of its class");
        __CPROVER_assert((before.stage == KEEL_STAGE_SETUP) || periods_hold(&scheduler),
                         "SCH_004_periods: after the start the periods hold the demand of all");
        __CPROVER_assert((before.stage == KEEL_STAGE_SETUP) || budgets_fit(&scheduler),
                         "SCH_004_fits: after the start the budgets fit the gaps");
        __CPROVER_assert((i >= place) || (scheduler.queue.task[i] == before.queue.task[i]),
                         "SCH_006_pass: the tasks of the pass stay where they are");
        __CPROVER_assert((task->release_us == (scheduler.clock.now_us + task->config->phase_us)) &&
                             (task->skipped == 0u) && (task->stats.runs == 0u) &&
                             (task->stats.longest_us == 0u),
                         "SCH_004_armed: its first release is a phase from now");
        __CPROVER_assert(scheduler.wake_us == 0u, "SCH_004_wake: the next step looks at it");
        if (before.running != KEEL_INDEX_NONE) {
            __CPROVER_assert(scheduler.queue.task[scheduler.running] ==
                                 before.queue.task[before.running],
                             "SCH_006_running: the running task is still known");
        } else {
            __CPROVER_assert(scheduler.running == KEEL_INDEX_NONE,
                             "SCH_006_running: with none running, none runs");
        }
        __CPROVER_assert((task == proof_task[t]) || task_same(proof_task[t], &task_before),
                         "SCH_004_others: other tasks are not written");
    } else {
        __CPROVER_assert(scheduler_same(&scheduler, &before, i) &&
                             task_same(proof_task[t], &task_before) &&
                             task_same(proof_task[NEWCOMER], &newcomer_before),
                         "SCH_005_unchanged: a refusal changes nothing");
    }
    __CPROVER_assert((scheduler.cursor == before.cursor) &&
                         (scheduler.pass_end == before.pass_end) &&
                         (scheduler.stage == before.stage) &&
                         (scheduler.busy_us == before.busy_us) &&
                         clock_same(&scheduler.clock, &before.clock),
                     "SCH_006_pass: the pass and the time go on as they were");
}
