#include "keel/rtos/scheduler.h"

/*@ predicate others_wait(keel_scheduler_t *s, integer now_us) =
  @     \forall integer i; s->queue.realtime_count <= i < s->queue.count ==>
  @         !may_run(s, s->queue.task[i], now_us);
  @*/

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> (config->guard_us < KEEL_PERIOD_LIMIT_US &&
  @                       config->utilisation_limit <= KEEL_UTILISATION_FULL_PPM);
  @*/
static bool config_is_valid(const keel_scheduler_config_t *config)
{
    return (config->guard_us < KEEL_PERIOD_LIMIT_US) &&
           (config->utilisation_limit <= KEEL_UTILISATION_FULL_PPM);
}

keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config)
{
    if ((scheduler == NULL) || (config == NULL) || (config->read_clock == NULL)) {
        return KEEL_ERR_NULL;
    }
    if (!config_is_valid(config)) {
        return KEEL_ERR_CONFIG;
    }
    keel_queue_init(&scheduler->queue);
    scheduler->config = *config;
    keel_clock_init(&scheduler->clock, 0u);
    scheduler->wake_us = 0u;
    scheduler->busy_us = 0u;
    scheduler->stage = KEEL_STAGE_SETUP;
    scheduler->cursor = 0u;
    scheduler->pass_end = 0u;
    scheduler->running = KEEL_INDEX_NONE;
    scheduler->ran = false;
    return KEEL_OK;
}

/* Admits the tasks in the queue in order, up to the first that is refused. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(admission) && \separated(admission, scheduler);
  @ requires \forall integer i; 0 <= i < scheduler->queue.count ==>
  @     \separated(admission, scheduler->queue.task[i]);
  @ requires \forall integer i; 0 <= i < scheduler->queue.count ==>
  @     \separated(admission, scheduler->queue.task[i]->config);
  @ assigns *admission;
  @ ensures valid: admission_valid(*admission);
  @ ensures offender: admission->tasks <= scheduler->queue.count;
  @ ensures all: \result == KEEL_OK <==> admission->tasks == scheduler->queue.count;
  @ ensures demand: \result == KEEL_OK ==>
  @     demand_admitted(&scheduler->queue, scheduler->config.guard_us);
  @ ensures gaps: \result == KEEL_OK ==>
  @     gaps_admitted(&scheduler->queue, scheduler->config.guard_us);
  @ ensures limits: admission->guard_us == scheduler->config.guard_us &&
  @     admission->utilisation_limit == scheduler->config.utilisation_limit;
  @ ensures totals: \result == KEEL_OK ==> admission->realtime_demand_us ==
  @         realtime_demand(&scheduler->queue, scheduler->queue.count) &&
  @     admission->utilisation == total_utilisation(&scheduler->queue, scheduler->queue.count);
  @ ensures some: \result == KEEL_OK ==> 0 < scheduler->queue.realtime_count ==>
  @     admission->realtime_demand_us > 0;
  @ ensures shortest_period: \result == KEEL_OK ==>
  @     \forall integer i; 0 <= i < scheduler->queue.realtime_count ==>
  @         admission->shortest_realtime_us <= scheduler->queue.task[i]->config->period_us;
  @ ensures shortest_gap: \result == KEEL_OK ==>
  @     \forall integer i; 0 <= i < scheduler->queue.realtime_count ==>
  @         admission->shortest_gap_us <= \max(0, scheduler->queue.task[i]->config->period_us
  @             - scheduler->queue.task[i]->config->budget_us);
  @ ensures longest_other: \result == KEEL_OK ==>
  @     \forall integer j; scheduler->queue.realtime_count <= j < scheduler->queue.count ==>
  @         admission->longest_other_us >= scheduler->queue.task[j]->config->budget_us;
  @*/
static keel_status_t admit_queue(const keel_scheduler_t *scheduler, keel_admission_t *admission)
{
    keel_admission_init(admission, scheduler->config.guard_us, scheduler->config.utilisation_limit);
    return keel_admission_queue(admission, &scheduler->queue);
}

keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted)
{
    keel_admission_t admission;
    const keel_status_t status = admit_queue(scheduler, &admission);

    *admitted = (uint32_t)admission.tasks;
    return status;
}

/* Whether the queue with one more task can be scheduled. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires scheduler->queue.count < KEEL_QUEUE_CAPACITY;
  @ requires \valid_read(config) && config_valid(config);
  @ assigns \nothing;
  @ ensures periods: \result == KEEL_OK ==>
  @     periods_hold_with(&scheduler->queue, config, scheduler->config.guard_us);
  @ ensures period: \result == KEEL_OK ==>
  @     period_holds_all(&scheduler->queue, config, scheduler->config.guard_us);
  @ ensures gaps: \result == KEEL_OK ==>
  @     gaps_admitted(&scheduler->queue, scheduler->config.guard_us);
  @ ensures fits: \result == KEEL_OK ==>
  @     fits_gaps(&scheduler->queue, config, scheduler->config.guard_us);
  @ ensures leaves: \result == KEEL_OK ==>
  @     leaves_gaps(&scheduler->queue, config, scheduler->config.guard_us);
  @ ensures utilisation: \result == KEEL_OK ==>
  @     total_utilisation(&scheduler->queue, scheduler->queue.count) + utilisation(config) <=
  @         scheduler->config.utilisation_limit;
  @*/
static keel_status_t admit_one_more(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *config)
{
    keel_admission_t admission;
    const keel_status_t status = admit_queue(scheduler, &admission);

    if (status != KEEL_OK) {
        return status;
    }
    return keel_admission_admit(&admission, config);
}

/* Lets the queue take a task in; the running task may move down by one slot. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(task) && \valid_read(task->config) && config_valid(task->config);
  @ requires task_apart(scheduler, task) && !queue_holds(&scheduler->queue, task);
  @ requires scheduler->queue.count < KEEL_QUEUE_CAPACITY;
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count;
  @ assigns scheduler->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns scheduler->running, scheduler->wake_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures ok: \result == KEEL_OK;
  @ ensures count: scheduler->queue.count == \old(scheduler->queue.count) + 1;
  @ ensures holds: queue_holds(&scheduler->queue, task);
  @ ensures wake: scheduler->wake_us == 0;
  @ ensures running: \old(scheduler->running) != KEEL_INDEX_NONE ==>
  @     scheduler->queue.task[scheduler->running] ==
  @         \old(scheduler->queue.task[scheduler->running]);
  @ ensures release: task->release_us == \old(task->release_us);
  @ ensures phase: task->config->phase_us == \old(task->config->phase_us);
  @ ensures stats: task->stats == \old(task->stats);
  @ ensures waiting: \old(setup_armed(scheduler)) ==>
  @     \old(task->release_us == scheduler->clock.now_us + task->config->phase_us) ==>
  @     setup_armed(scheduler);
  @*/
static keel_status_t enqueue(keel_scheduler_t *scheduler, keel_task_t *task)
{
    const uint32_t place = scheduler->queue.realtime_count;
    const keel_status_t status = keel_queue_add(&scheduler->queue, task);

    /*@ assert placed:
      @     scheduler->queue.task[\at(queue_place(&scheduler->queue, task), Pre)] == task;
      @*/
    /*@ assert origin: \forall integer i; 0 <= i < scheduler->queue.count ==>
      @     scheduler->queue.task[i] == task || (\exists integer j;
      @         0 <= j < \at(scheduler->queue.count, Pre) &&
      @         scheduler->queue.task[i] == \at(scheduler->queue.task[j], Pre));
      @*/
    /*@ assert declared: \forall integer j; 0 <= j < \at(scheduler->queue.count, Pre) ==>
      @     \at(\at(scheduler->queue.task[j], Pre)->config, Here) ==
      @         \at(scheduler->queue.task[j]->config, Pre);
      @*/
    /*@ assert checked_old: \forall integer j; 0 <= j < \at(scheduler->queue.count, Pre) ==>
      @     config_valid(\at(scheduler->queue.task[j]->config, Pre));
      @*/
    //@ assert checked: queue_checked(&scheduler->queue);
    /*@ assert running_before:
      @     scheduler->running < \at(queue_place(&scheduler->queue, task), Pre) ==>
      @     scheduler->queue.task[scheduler->running] ==
      @         \at(scheduler->queue.task[scheduler->running], Pre);
      @*/
    /*@ assert running_behind: \at(queue_place(&scheduler->queue, task), Pre) <=
      @         scheduler->running < \at(scheduler->queue.count, Pre) ==>
      @     scheduler->queue.task[scheduler->running + 1] ==
      @         \at(scheduler->queue.task[scheduler->running], Pre);
      @*/
    /*@ assert waiting: \at(setup_armed(scheduler), Pre) ==>
      @     scheduler->stage == KEEL_STAGE_SETUP ==> \forall integer i;
      @     0 <= i < scheduler->queue.count ==> scheduler->queue.task[i] != task ==>
      @     scheduler->queue.task[i]->release_us == scheduler->queue.task[i]->config->phase_us;
      @*/
    //@ assert apart: scheduler_apart(scheduler);
    //@ assert tasks_apart: tasks_apart(scheduler);
    //@ assert configs_apart: configs_apart(scheduler);
    if (keel_task_is_realtime(task) && (scheduler->running != KEEL_INDEX_NONE) &&
        (scheduler->running >= place)) {
        scheduler->running++;
    }
    scheduler->wake_us = 0u;
    return status;
}

/* Puts a task that was found fit into the queue, to be released a phase from now. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires \valid(task) && \valid_read(task->config) && config_valid(task->config);
  @ requires task_apart(scheduler, task) && !queue_holds(&scheduler->queue, task);
  @ requires scheduler->queue.count < KEEL_QUEUE_CAPACITY;
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count;
  @ assigns scheduler->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns scheduler->running, scheduler->wake_us;
  @ assigns task->skipped, task->release_us, STATS_FIELDS(task->stats);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures ok: \result == KEEL_OK;
  @ ensures count: scheduler->queue.count == \old(scheduler->queue.count) + 1;
  @ ensures armed: task->release_us == scheduler->clock.now_us + task->config->phase_us;
  @ ensures skipped: task->skipped == 0;
  @ ensures fresh: stats_fresh(task->stats);
  @ ensures declared: config_valid(task->config);
  @ ensures waiting: \old(setup_armed(scheduler)) ==> setup_armed(scheduler);
  @ ensures wake: scheduler->wake_us == 0;
  @ ensures stage: scheduler->stage == \old(scheduler->stage);
  @ ensures now: scheduler->clock.now_us == \old(scheduler->clock.now_us);
  @ ensures busy: scheduler->busy_us == \old(scheduler->busy_us);
  @ ensures pass: scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->cursor == \old(scheduler->cursor);
  @ ensures running: \old(scheduler->running) != KEEL_INDEX_NONE ==>
  @     scheduler->queue.task[scheduler->running] ==
  @         \old(scheduler->queue.task[scheduler->running]);
  @*/
static keel_status_t insert(keel_scheduler_t *scheduler, keel_task_t *task)
{
    keel_task_arm(task, scheduler->clock.now_us);
    //@ assert no_gaps: queue_no_gaps(&scheduler->queue);
    //@ assert configs: queue_configs_valid(&scheduler->queue);
    //@ assert realtime: queue_realtime_first(&scheduler->queue);
    //@ assert others: queue_others_last(&scheduler->queue);
    //@ assert checked: queue_checked(&scheduler->queue);
    //@ assert apart: scheduler_apart(scheduler) && task_apart(scheduler, task);
    //@ assert tasks_apart: tasks_apart(scheduler);
    //@ assert configs_apart: configs_apart(scheduler);
    //@ assert state: scheduler_state(scheduler);
    //@ assert declared: config_valid(task->config);
    //@ assert waiting: \at(setup_armed(scheduler), Pre) ==> setup_armed(scheduler);
    return enqueue(scheduler, task);
}

keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, keel_task_t *task)
{
    keel_status_t status;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL;
    }
    status = keel_task_check(task->config);
    if (status != KEEL_OK) {
        return status;
    }
    if (keel_queue_find(&scheduler->queue, task) < scheduler->queue.count) {
        return KEEL_ERR_DUPLICATE;
    }
    if (scheduler->queue.count == KEEL_QUEUE_CAPACITY) {
        return KEEL_ERR_FULL;
    }
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        status = admit_one_more(scheduler, task->config);
        if (status != KEEL_OK) {
            return status;
        }
    }
    return insert(scheduler, task);
}

/* Keeps the indices of a pass right when the task at an index goes. */
/*@ requires \valid(scheduler) && scheduler_state(scheduler);
  @ requires index < scheduler->queue.count;
  @ assigns scheduler->cursor, scheduler->pass_end, scheduler->running;
  @ ensures cursor: scheduler->cursor == \old(scheduler->cursor)
  @     - ((index < \old(scheduler->cursor)) ? 1 : 0);
  @ ensures pass_end: scheduler->pass_end == \old(scheduler->pass_end)
  @     - ((index < \old(scheduler->pass_end)) ? 1 : 0);
  @ ensures none: \old(scheduler->running) == KEEL_INDEX_NONE ||
  @     \old(scheduler->running) == index ==> scheduler->running == KEEL_INDEX_NONE;
  @ ensures shifted: \old(scheduler->running) != KEEL_INDEX_NONE &&
  @     \old(scheduler->running) != index ==> scheduler->running ==
  @         \old(scheduler->running) - ((index < \old(scheduler->running)) ? 1 : 0);
  @*/
static void shift_up(keel_scheduler_t *scheduler, uint32_t index)
{
    if (index < scheduler->cursor) {
        scheduler->cursor--;
    }
    if (index < scheduler->pass_end) {
        scheduler->pass_end--;
    }
    if (scheduler->running == index) {
        scheduler->running = KEEL_INDEX_NONE;
    } else if ((scheduler->running != KEEL_INDEX_NONE) && (scheduler->running > index)) {
        scheduler->running--;
    } else {
        /* The running task stands before the gap, or there is none. */
    }
}

/* Takes the task at an index out of the queue and keeps the indices of the pass right. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires index < scheduler->queue.count;
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count;
  @ assigns scheduler->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns scheduler->cursor, scheduler->pass_end, scheduler->running, scheduler->wake_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures ok: \result == KEEL_OK;
  @ ensures gone: !queue_holds(&scheduler->queue, \old(scheduler->queue.task[index]));
  @ ensures waiting: \old(setup_armed(scheduler)) ==> setup_armed(scheduler);
  @ ensures count: scheduler->queue.count == \old(scheduler->queue.count) - 1;
  @ ensures wake: scheduler->wake_us == 0;
  @ ensures cursor: \old(scheduler->cursor) < \old(scheduler->pass_end) &&
  @     \old(scheduler->cursor) != index ==>
  @     scheduler->queue.task[scheduler->cursor] ==
  @         \old(scheduler->queue.task[scheduler->cursor]);
  @ ensures running: \old(scheduler->running) != KEEL_INDEX_NONE &&
  @     \old(scheduler->running) != index ==>
  @     scheduler->queue.task[scheduler->running] ==
  @         \old(scheduler->queue.task[scheduler->running]);
  @ ensures forgotten: \old(scheduler->running) == index ==>
  @     scheduler->running == KEEL_INDEX_NONE;
  @ ensures pass: scheduler->pass_end - scheduler->cursor <=
  @     \old(scheduler->pass_end - scheduler->cursor);
  @*/
static keel_status_t take_out(keel_scheduler_t *scheduler, uint32_t index)
{
    keel_status_t status;

    shift_up(scheduler, index);
    scheduler->wake_us = 0u;
    status = keel_queue_remove(&scheduler->queue, index);
    /*@ assert origin: \forall integer i; 0 <= i < scheduler->queue.count ==> \exists integer j;
      @     0 <= j < \at(scheduler->queue.count, Pre) &&
      @     scheduler->queue.task[i] == \at(scheduler->queue.task[j], Pre);
      @*/
    /*@ assert declared: \forall integer j; 0 <= j < \at(scheduler->queue.count, Pre) ==>
      @     \at(\at(scheduler->queue.task[j], Pre)->config, Here) ==
      @         \at(scheduler->queue.task[j]->config, Pre);
      @*/
    return status;
}

keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, keel_task_t *task)
{
    uint32_t index;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL;
    }
    index = keel_queue_find(&scheduler->queue, task);
    if (index == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    return take_out(scheduler, index);
}

keel_status_t keel_scheduler_start_at(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_admission_t admission;
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE;
    }
    status = admit_queue(scheduler, &admission);
    if (status != KEEL_OK) {
        return status;
    }
    keel_clock_init(&scheduler->clock, raw_us);
    scheduler->stage = KEEL_STAGE_READY;
    return KEEL_OK;
}

keel_status_t keel_scheduler_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE;
    }
    status = keel_clock_advance(&scheduler->clock, raw_us);
    if (status != KEEL_OK) {
        return status;
    }
    if (scheduler->clock.now_us < scheduler->wake_us) {
        return KEEL_OK;
    }
    scheduler->wake_us = 0u;
    scheduler->stage = KEEL_STAGE_PASS;
    scheduler->cursor = 0u;
    scheduler->pass_end = (uint16_t)scheduler->queue.realtime_count;
    scheduler->ran = false;
    return KEEL_OK;
}

/* Takes the task at an index into service: its next release, and what finish has to know. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires index < scheduler->queue.count;
  @ requires scheduler->stage == KEEL_STAGE_PASS && cursor <= scheduler->pass_end;
  @ requires stage == KEEL_STAGE_REALTIME || stage == KEEL_STAGE_OTHER;
  @ requires released(scheduler->queue.task[index], scheduler->clock.now_us);
  @ assigns scheduler->cursor, scheduler->running, scheduler->stage, scheduler->ran;
  @ assigns scheduler->queue.task[index]->skipped, scheduler->queue.task[index]->release_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures task: \result == scheduler->queue.task[index];
  @ ensures running: scheduler->running == index && scheduler->stage == stage && scheduler->ran;
  @ ensures cursor: scheduler->cursor == cursor;
  @ ensures pass_end: scheduler->pass_end == \old(scheduler->pass_end);
  @ ensures release: scheduler->clock.now_us < \result->release_us;
  @ ensures on_time: scheduler->clock.now_us <
  @     \at(\result->release_us, Pre) + \result->config->period_us ==>
  @     \result->release_us == \at(\result->release_us, Pre) + \result->config->period_us;
  @ ensures others: \forall integer k; 0 <= k < scheduler->queue.count && k != index ==>
  @     release_same{Pre, Post}(scheduler, k);
  @*/
static keel_task_t *dispatch(keel_scheduler_t *scheduler, uint16_t index, uint16_t cursor,
                             uint8_t stage)
{
    keel_task_t *const task = scheduler->queue.task[index];

    keel_task_advance(task, scheduler->clock.now_us);
    scheduler->cursor = cursor;
    scheduler->running = index;
    scheduler->stage = stage;
    scheduler->ran = true;
    return task;
}

/*@ requires \valid_read(task) && \valid_read(task->config) && config_valid(task->config);
  @ requires released(task, now_us) && now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @ assigns \nothing;
  @ ensures \result <==> promoted(task, now_us);
  @*/
static bool is_promoted(const keel_task_t *task, uint64_t now_us)
{
    const uint32_t period_us = task->config->period_us;

    return keel_priority_promoted(task->config->priority, (now_us - task->release_us) + period_us,
                                  period_us);
}

/* Ends a pass in which nothing is left to run; sets the wake-up time if nothing ran at all, as
 * otherwise time has passed since the pass looked at the first tasks. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->stage == KEEL_STAGE_PASS;
  @ requires others_wait(scheduler, scheduler->clock.now_us);
  @ assigns scheduler->wake_us, scheduler->cursor, scheduler->stage;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures wake: wake_right(scheduler);
  @ ensures stage: scheduler->stage == KEEL_STAGE_READY;
  @ ensures cursor: scheduler->cursor == scheduler->pass_end;
  @ ensures bound: !scheduler->ran ==> \forall integer i; 0 <= i < scheduler->queue.count ==>
  @     scheduler->wake_us <= next_event(scheduler->queue.task[i], scheduler->clock.now_us);
  @ ensures exact: !scheduler->ran ==> scheduler->wake_us == KEEL_TIME_NEVER_US ||
  @     (\exists integer i; 0 <= i < scheduler->queue.count && scheduler->wake_us ==
  @         next_event(scheduler->queue.task[i], scheduler->clock.now_us));
  @*/
static void close_pass(keel_scheduler_t *scheduler)
{
    if (!scheduler->ran) {
        scheduler->wake_us = keel_decision_wake_us(&scheduler->queue, scheduler->clock.now_us);
    }
    scheduler->cursor = scheduler->pass_end;
    scheduler->stage = KEEL_STAGE_READY;
    /*@ assert wake_realtime: scheduler->clock.now_us < scheduler->wake_us ==>
      @     wake_realtime(scheduler);
      @*/
    //@ assert wake_others: scheduler->clock.now_us < scheduler->wake_us ==> wake_others(scheduler);
}

keel_task_t *keel_scheduler_next(keel_scheduler_t *scheduler)
{
    const uint64_t now_us = scheduler->clock.now_us;
    keel_task_t *task = NULL;
    uint64_t slack_us;
    uint32_t index;

    if (scheduler->stage != KEEL_STAGE_PASS) {
        return NULL;
    }
    index = keel_decision_realtime(&scheduler->queue, scheduler->cursor, scheduler->pass_end,
                                   now_us);
    if (index < scheduler->pass_end) {
        return dispatch(scheduler, (uint16_t)index, (uint16_t)(index + 1u), KEEL_STAGE_REALTIME);
    }
    slack_us = keel_decision_slack_us(&scheduler->queue, now_us);
    /*@ assert slack: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
      @     (may_run(scheduler, scheduler->queue.task[i], now_us) <==>
      @      eligible(scheduler->queue.task[i], now_us, slack_us, scheduler->config.guard_us));
      @*/
    index = keel_decision_other(&scheduler->queue, now_us, slack_us, scheduler->config.guard_us);
    if (index < scheduler->queue.count) {
        const bool by_promotion = is_promoted(scheduler->queue.task[index], now_us);

        task = dispatch(scheduler, (uint16_t)index, scheduler->pass_end, KEEL_STAGE_OTHER);
        if (by_promotion) {
            keel_stats_promote(&task->stats);
        }
    } else {
        close_pass(scheduler);
    }
    return task;
}

/* Ends the run of a task: takes the time and counts it as busy; the pass goes on after a real-time
 * task, unless the clock is broken, which the caller learns. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->busy_us <= scheduler->clock.now_us && stage_running(scheduler);
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->busy_us, scheduler->stage,
  @     scheduler->running;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ DECLARATIONS_STAY(scheduler)
  @ ensures releases: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @     scheduler->queue.task[k]->release_us == \old(scheduler->queue.task[k]->release_us);
  @ ensures longest: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @     scheduler->queue.task[k]->stats.longest_us ==
  @         \old(scheduler->queue.task[k]->stats.longest_us);
  @ ensures result: \result == ((clock_elapsed(\old(scheduler->clock.raw_us), raw_us) <
  @     KEEL_CLOCK_STEP_LIMIT_US) ? KEEL_OK : KEEL_ERR_CLOCK);
  @ ensures time: scheduler->clock.now_us == \old(scheduler->clock.now_us) +
  @     ((\result == KEEL_OK) ? clock_elapsed(\old(scheduler->clock.raw_us), raw_us) : 0);
  @ ensures raw: \result == KEEL_OK ==> scheduler->clock.raw_us == raw_us;
  @ ensures busy: scheduler->busy_us == \old(scheduler->busy_us) +
  @     scheduler->clock.now_us - \old(scheduler->clock.now_us);
  @ ensures stage: scheduler->stage == ((\result == KEEL_OK &&
  @     \old(scheduler->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @ ensures running: scheduler->running == KEEL_INDEX_NONE;
  @*/
static keel_status_t end_run(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const bool realtime = scheduler->stage == KEEL_STAGE_REALTIME;
    const keel_status_t status = keel_clock_advance(&scheduler->clock, raw_us);

    scheduler->stage = ((status == KEEL_OK) && realtime) ? KEEL_STAGE_PASS : KEEL_STAGE_READY;
    scheduler->running = KEEL_INDEX_NONE;
    scheduler->busy_us += scheduler->clock.now_us - start_us;
    return status;
}

/* Records in the statistics of the task at an index how long it ran. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires index < scheduler->queue.count;
  @ assigns STATS_FIELDS(scheduler->queue.task[index]->stats);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ DECLARATIONS_STAY(scheduler)
  @ ensures releases: \forall integer k; 0 <= k < scheduler->queue.count ==>
  @     scheduler->queue.task[k]->release_us == \old(scheduler->queue.task[k]->release_us);
  @ ensures last: scheduler->queue.task[index]->stats.last_us == ran_us;
  @ ensures longest: scheduler->queue.task[index]->stats.longest_us ==
  @     \max(\old(scheduler->queue.task[index]->stats.longest_us), ran_us);
  @ ensures others: \forall integer k; 0 <= k < scheduler->queue.count && k != index ==>
  @     scheduler->queue.task[k]->stats.longest_us ==
  @         \old(scheduler->queue.task[k]->stats.longest_us);
  @ ensures clock: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->clock.raw_us == \old(scheduler->clock.raw_us);
  @ ensures pass: scheduler->cursor == \old(scheduler->cursor) &&
  @     scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->wake_us == \old(scheduler->wake_us);
  @ ensures state: scheduler->stage == \old(scheduler->stage) &&
  @     scheduler->running == \old(scheduler->running) &&
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @*/
static void record_run(const keel_scheduler_t *scheduler, uint32_t index, uint32_t ran_us)
{
    keel_task_t *const task = scheduler->queue.task[index];

    //@ assert apart_scheduler: \separated(scheduler, task);
    /*@ assert apart: \forall integer k; 0 <= k < scheduler->queue.count ==> k != index ==>
      @     \separated(task, scheduler->queue.task[k]);
      @*/
    keel_stats_record(&task->stats, ran_us, task->config->budget_us);
}

keel_status_t keel_scheduler_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const uint16_t index = scheduler->running;
    keel_status_t status;

    if ((scheduler->stage != KEEL_STAGE_REALTIME) && (scheduler->stage != KEEL_STAGE_OTHER)) {
        return KEEL_ERR_STATE;
    }
    status = end_run(scheduler, raw_us);
    if ((status == KEEL_OK) && (index != KEEL_INDEX_NONE)) {
        record_run(scheduler, index, (uint32_t)(scheduler->clock.now_us - start_us));
    }
    return status;
}

/*@ requires \valid_read(scheduler) && clock_modelled(scheduler);
  @ assigns \nothing;
  @*/
static uint32_t read_clock(const keel_scheduler_t *scheduler)
{
    //@ calls keel_any_clock;
    return scheduler->config.read_clock(scheduler->config.clock_context);
}

keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler)
{
    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    return keel_scheduler_start_at(scheduler, read_clock(scheduler));
}

keel_status_t keel_scheduler_run_pass(keel_scheduler_t *scheduler)
{
    keel_status_t status = KEEL_OK;

    /*@ loop invariant same: scheduler == running_scheduler && scheduler == \at(scheduler, Pre);
      @ loop invariant memory: \valid(scheduler);
      @ loop invariant valid: scheduler_valid(scheduler);
      @ loop invariant uptime: in_uptime(scheduler);
      @ loop invariant wake: wake_right(scheduler);
      @ loop invariant clock: clock_modelled(scheduler);
      @ loop invariant bodies: bodies_modelled(scheduler);
      @ loop invariant stage: scheduler->stage == KEEL_STAGE_READY ||
      @     scheduler->stage == KEEL_STAGE_PASS;
      @ loop invariant status: status == KEEL_OK || status == KEEL_ERR_CLOCK;
      @ loop invariant left: scheduler->stage == KEEL_STAGE_PASS ==>
      @     uptime_left(scheduler, scheduler->pass_end - scheduler->cursor + 1);
      @ loop invariant time: \at(scheduler->clock.now_us, Pre) <= scheduler->clock.now_us;
      @ loop invariant busy: scheduler->busy_us <= scheduler->clock.now_us;
      @ loop variant scheduler->pass_end - scheduler->cursor
      @     + ((scheduler->stage == KEEL_STAGE_PASS) ? 1 : 0);
      @*/
    while (scheduler->stage == KEEL_STAGE_PASS) {
        const keel_task_t *const task = keel_scheduler_next(scheduler);

        if (task != NULL) {
            //@ calls keel_any_body;
            task->config->run(task->config->context);
            //@ assert awake: scheduler->wake_us == 0;
            status = keel_scheduler_finish(scheduler, read_clock(scheduler));
        }
    }
    return status;
}

keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    status = keel_scheduler_begin(scheduler, read_clock(scheduler));
    if ((status != KEEL_OK) || (scheduler->stage != KEEL_STAGE_PASS)) {
        return status;
    }
    return keel_scheduler_run_pass(scheduler);
}

keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler)
{
    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE;
    }
    scheduler->clock.raw_us = read_clock(scheduler);
    return KEEL_OK;
}
