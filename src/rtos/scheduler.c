/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/scheduler.h"

#include <stdbool.h>
#include <stddef.h>

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> settings_valid(config);
  @*/
static bool config_is_valid(const keel_scheduler_config_t *config)
{
    return (config->guard_us < KEEL_PERIOD_LIMIT_US) &&
           (config->utilisation_limit_ppm <= KEEL_UTILISATION_FULL_PPM);
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
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->stage = KEEL_STAGE_SETUP;
    scheduler->cursor = 0;
    scheduler->pass_end = 0;
    scheduler->running = KEEL_POSITION_NONE;
    return KEEL_OK;
}

/* Admits the tasks in the queue in order, up to the first that is refused. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(admission) && \separated(admission, scheduler);
  @ assigns *admission;
  @ ensures valid: admission_valid(*admission);
  @ ensures limits: admission->guard_us == scheduler->config.guard_us &&
  @     admission->utilisation_limit_ppm == scheduler->config.utilisation_limit_ppm;
  @ ensures range: admission->tasks <= scheduler->queue.count;
  @ ensures totals: totals_of(*admission, &scheduler->queue, admission->tasks);
  @ ensures all: \result == KEEL_OK <==> admission->tasks == scheduler->queue.count;
  @ ensures offender: \result != KEEL_OK ==>
  @     scheduler_refused(scheduler, admission->tasks + 1, \result);
  @ ensures before: scheduler_holds_of(scheduler, admission->tasks);
  @ ensures complete: \result == KEEL_OK <==> scheduler_holds(scheduler);
  @ ensures demand: \result == KEEL_OK ==>
  @     demand_admitted(&scheduler->queue, scheduler->config.guard_us);
  @ ensures gaps: \result == KEEL_OK ==>
  @     gaps_admitted(&scheduler->queue, scheduler->config.guard_us);
  @*/
static keel_status_t admit_queue(const keel_scheduler_t *scheduler, keel_admission_t *admission)
{
    keel_status_t status;

    keel_admission_init(admission, scheduler->config.guard_us,
                        scheduler->config.utilisation_limit_ppm);
    status = keel_admission_queue(admission, &scheduler->queue);
    /*@ assert demand: demand_holds(&scheduler->queue, admission->tasks,
      @     scheduler->config.guard_us);
      @*/
    //@ assert gap: gap_holds(&scheduler->queue, admission->tasks, scheduler->config.guard_us);
    /*@ assert utilisation: utilisation_holds(&scheduler->queue, admission->tasks,
      @     scheduler->config.utilisation_limit_ppm);
      @*/
    return status;
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
  @ requires \valid_read(task) && config_valid(task);
  @ assigns \nothing;
  @ ensures all: \result == KEEL_OK <==> (scheduler_holds(scheduler) &&
  @     demand_allows(scheduler, task) && gap_allows(scheduler, task) &&
  @     utilisation_allows(scheduler, task));
  @ ensures reason: \result == KEEL_OK || admission_status(\result);
  @ ensures rule: \result != KEEL_OK ==> scheduler_holds(scheduler) ==>
  @     refuses(scheduler, task, \result);
  @*/
static keel_status_t admit_one_more(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *task)
{
    keel_admission_t admission;
    const keel_status_t status = admit_queue(scheduler, &admission);

    if (status != KEEL_OK) {
        return status;
    }
    return keel_admission_admit(&admission, task->priority, task->period_us, task->budget_us);
}

/* Puts a task into the queue, to be released a phase from now. */
/*@ requires \valid(scheduler) && queue_valid(&scheduler->queue) && in_uptime(scheduler);
  @ requires \valid_read(task) && \separated(scheduler, task) && addable(scheduler, task);
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count,
  @     scheduler->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns QUEUE_SLOT(&scheduler->queue, scheduler->queue.order[scheduler->queue.count]);
  @ ensures queue: queue_valid(&scheduler->queue);
  @ ensures order: order_joined{Pre, Post}(&scheduler->queue, task->priority);
  @ ensures copied: slot_copied(&scheduler->queue,
  @     \old(scheduler->queue.order[scheduler->queue.count]), task);
  @ ensures fresh: SLOT_FRESH(&scheduler->queue,
  @     \old(scheduler->queue.order[scheduler->queue.count]));
  @ ensures release:
  @     scheduler->queue.release_us[\old(scheduler->queue.order[scheduler->queue.count])] ==
  @     \old(scheduler->clock.now_us + task->phase_us);
  @ ensures phase: task->phase_us == \old(task->phase_us);
  @ ensures time: scheduler->clock.now_us == \old(scheduler->clock.now_us);
  @ ensures guard: scheduler->config.guard_us == \old(scheduler->config.guard_us);
  @ ensures limit: scheduler->config.utilisation_limit_ppm ==
  @     \old(scheduler->config.utilisation_limit_ppm);
  @*/
static void add_to_queue(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    keel_queue_add(&scheduler->queue, task, scheduler->clock.now_us + task->phase_us);
    /*@ assert slot: 0 <= \at(scheduler->queue.order[scheduler->queue.count], Pre) <
      @     KEEL_QUEUE_CAPACITY;
      @*/
}

/* Puts a task that was found fit into the queue, to be released a phase from now; the running task
 * may move down by one position. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires \valid_read(task) && \separated(scheduler, task) && addable(scheduler, task);
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count,
  @     scheduler->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns QUEUE_SLOT(&scheduler->queue, scheduler->queue.order[scheduler->queue.count]);
  @ assigns scheduler->running, scheduler->wake_us, scheduler->earliest_realtime_us,
  @     scheduler->earliest_other_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures order: order_joined{Pre, Post}(&scheduler->queue, task->priority);
  @ ensures copied: slot_copied(&scheduler->queue,
  @     \old(scheduler->queue.order[scheduler->queue.count]), task);
  @ ensures fresh: SLOT_FRESH(&scheduler->queue,
  @     \old(scheduler->queue.order[scheduler->queue.count]));
  @ ensures release:
  @     scheduler->queue.release_us[\old(scheduler->queue.order[scheduler->queue.count])] ==
  @     scheduler->clock.now_us + task->phase_us;
  @ ensures wake: nothing_known(scheduler);
  @ ensures running: running_joined{Pre, Post}(scheduler, task->priority);
  @*/
static void insert_task(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    const int16_t place = (int16_t)scheduler->queue.realtime_count;

    add_to_queue(scheduler, task);
    /*@ assert slot: 0 <= \at(scheduler->queue.order[scheduler->queue.count], Pre) <
      @     KEEL_QUEUE_CAPACITY;
      @*/
    //@ assert guard: scheduler->config.guard_us == \at(scheduler->config.guard_us, Pre);
    /*@ assert limit: scheduler->config.utilisation_limit_ppm ==
      @     \at(scheduler->config.utilisation_limit_ppm, Pre);
      @*/
    if ((task->priority == KEEL_PRIORITY_REALTIME) && (scheduler->running >= place)) {
        scheduler->running++;
    }
    /*@ assert fresh: SLOT_FRESH(&scheduler->queue,
      @     \at(scheduler->queue.order[scheduler->queue.count], Pre));
      @*/
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->wake_us = 0u;
}

keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    status = keel_task_check(task);
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
        status = admit_one_more(scheduler, task);
        if (status != KEEL_OK) {
            return status;
        }
    }
    insert_task(scheduler, task);
    return KEEL_OK;
}

/* Keeps the positions of a pass right when the task at a position goes. */
/*@ requires \valid(scheduler) && scheduler_state(scheduler);
  @ requires position < scheduler->queue.count && queue_counts(&scheduler->queue);
  @ assigns scheduler->cursor, scheduler->pass_end, scheduler->running;
  @ ensures pass: pass_left{Pre, Post}(scheduler, position);
  @*/
static void shift_pass(keel_scheduler_t *scheduler, uint32_t position)
{
    const int16_t gone = (int16_t)position;

    if (gone < scheduler->cursor) {
        scheduler->cursor--;
    }
    if (gone < scheduler->pass_end) {
        scheduler->pass_end--;
    }
    if (scheduler->running == gone) {
        scheduler->running = KEEL_POSITION_NONE;
    } else if (scheduler->running > gone) {
        scheduler->running--;
    } else {
        /* The running task stands before the gap, or there is none. */
    }
}

/* Takes the task at a position out of the queue and keeps the positions of the pass right. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires position < scheduler->queue.count;
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count,
  @     scheduler->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.task[scheduler->queue.order[position]];
  @ assigns scheduler->cursor, scheduler->pass_end, scheduler->running, scheduler->wake_us,
  @     scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures gone: !queue_holds(&scheduler->queue,
  @     \old(scheduler->queue.task[scheduler->queue.order[position]]));
  @ ensures order: order_left{Pre, Post}(&scheduler->queue, position);
  @ ensures freed: scheduler->queue.task[\old(scheduler->queue.order[position])] == \null;
  @ ensures pass: pass_left{Pre, Post}(scheduler, position);
  @ ensures wake: nothing_known(scheduler);
  @*/
static void remove_task(keel_scheduler_t *scheduler, uint32_t position)
{
    shift_pass(scheduler, position);
    keel_queue_remove(&scheduler->queue, position);
    scheduler->earliest_realtime_us = 0u;
    scheduler->earliest_other_us = 0u;
    scheduler->wake_us = 0u;
}

keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    uint32_t position;

    if ((scheduler == NULL) || (task == NULL)) {
        return KEEL_ERR_NULL;
    }
    position = keel_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    remove_task(scheduler, position);
    return KEEL_OK;
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
    keel_admission_t admission;
    uint32_t raw_us;
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    raw_us = read_clock(scheduler);
    if (scheduler->stage != KEEL_STAGE_SETUP) {
        return KEEL_ERR_STATE;
    }
    status = admit_queue(scheduler, &admission);
    if (status != KEEL_OK) {
        return status;
    }
    keel_clock_init(&scheduler->clock, raw_us);
    scheduler->earliest_realtime_us = 0u;
    scheduler->stage = KEEL_STAGE_READY;
    return KEEL_OK;
}

keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    if (scheduler == NULL) {
        return KEEL_ERR_NULL;
    }
    status = keel_pass_begin(scheduler, read_clock(scheduler));
    if ((status != KEEL_OK) || (scheduler->stage != KEEL_STAGE_PASS)) {
        return status;
    }
    return keel_pass_run(scheduler);
}

uint32_t keel_scheduler_idle_us(const keel_scheduler_t *scheduler, uint32_t latency_us,
                                uint32_t longest_us)
{
    if (scheduler == NULL) {
        return 0u;
    }
    return keel_pass_idle_us(scheduler, read_clock(scheduler), latency_us, longest_us);
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

const keel_task_config_t *keel_scheduler_task(const keel_scheduler_t *scheduler, uint32_t position)
{
    if ((scheduler == NULL) || (position >= scheduler->queue.count)) {
        return NULL;
    }
    return scheduler->queue.task[scheduler->queue.order[position]];
}

keel_status_t keel_scheduler_report(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *task, keel_task_report_t *report)
{
    uint32_t position;
    uint32_t slot;

    if ((scheduler == NULL) || (task == NULL) || (report == NULL)) {
        return KEEL_ERR_NULL;
    }
    position = keel_queue_find(&scheduler->queue, task);
    if (position == scheduler->queue.count) {
        return KEEL_ERR_UNKNOWN_TASK;
    }
    slot = scheduler->queue.order[position];
    report->release_us = scheduler->queue.release_us[slot];
    report->skipped = scheduler->queue.skipped[slot];
    report->stats = scheduler->queue.stats[slot];
    return KEEL_OK;
}
