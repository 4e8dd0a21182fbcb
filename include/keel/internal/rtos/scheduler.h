/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/scheduler.h
 * @brief The contracts of scheduler.h, as the provers read them.
 */
#ifndef KEEL_INTERNAL_RTOS_SCHEDULER_H
#define KEEL_INTERNAL_RTOS_SCHEDULER_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/admission.h"
#include "keel/internal/rtos/pass.h"
#include "keel/internal/rtos/scheduler_state.h"
#include "keel/internal/rtos/task.h"
#include "keel/rtos/scheduler.h"

KEEL_C_BEGIN

/*@ requires (scheduler == \null || \valid(scheduler)) && (config == \null || \valid_read(config));
  @ requires scheduler != \null && config != \null ==> \separated(scheduler, config);
  @ assigns *scheduler;
  @ behavior null:
  @   assumes scheduler == \null || config == \null || config->read_clock == \null;
  @   assigns \nothing;
  @   ensures SCH_002_null: \result == KEEL_ERR_NULL;
  @ behavior config:
  @   assumes scheduler != \null && config != \null && config->read_clock != \null;
  @   assumes !settings_valid(config);
  @   assigns \nothing;
  @   ensures SCH_002_config: \result == KEEL_ERR_CONFIG;
  @ behavior done:
  @   assumes scheduler != \null && config != \null && config->read_clock != \null;
  @   assumes settings_valid(config);
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_001_valid: scheduler_valid(scheduler);
  @   ensures SCH_001_config: config_copied(scheduler, config);
  @   ensures SCH_001_empty: scheduler_fresh(scheduler);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_init(keel_scheduler_t *scheduler,
                                  const keel_scheduler_config_t *config);

/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ requires \valid(admitted) && \separated(admitted, scheduler);
  @ assigns *admitted;
  @ ensures SCH_003_range: *admitted <= scheduler->queue.count;
  @ ensures SCH_003_all: \result == KEEL_OK <==> *admitted == scheduler->queue.count;
  @ ensures SCH_003_complete: \result == KEEL_OK <==> \old(scheduler_holds(scheduler));
  @ ensures SCH_003_before: \at(scheduler_holds_of(scheduler, \at(*admitted, Post)), Pre);
  @ ensures SCH_003_offender: \result != KEEL_OK ==>
  @     \at(scheduler_refused(scheduler, \at(*admitted, Post) + 1, \at(\result, Post)), Pre);
  @*/
keel_status_t keel_scheduler_check(const keel_scheduler_t *scheduler, uint32_t *admitted);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     in_uptime(scheduler));
  @ requires task == \null || \valid_read(task);
  @ requires scheduler != \null && task != \null ==> \separated(scheduler, task);
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count,
  @     scheduler->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns QUEUE_SLOT(&scheduler->queue, scheduler->queue.order[scheduler->queue.count]);
  @ assigns scheduler->running, scheduler->wake_us, scheduler->earliest_realtime_us,
  @     scheduler->earliest_other_us;
  @ behavior null:
  @   assumes scheduler == \null || task == \null || task->run == \null;
  @   assigns \nothing;
  @   ensures SCH_005_null: \result == KEEL_ERR_NULL;
  @ behavior invalid:
  @   assumes scheduler != \null && task != \null && task->run != \null && !config_valid(task);
  @   assigns \nothing;
  @   ensures SCH_005_invalid: config_refused(task, \result);
  @ behavior duplicate:
  @   assumes scheduler != \null && task != \null && config_valid(task);
  @   assumes queue_holds(&scheduler->queue, task);
  @   assigns \nothing;
  @   ensures SCH_005_duplicate: \result == KEEL_ERR_DUPLICATE;
  @ behavior full:
  @   assumes scheduler != \null && task != \null && config_valid(task);
  @   assumes !queue_holds(&scheduler->queue, task);
  @   assumes scheduler->queue.count == KEEL_QUEUE_CAPACITY;
  @   assigns \nothing;
  @   ensures SCH_005_full: \result == KEEL_ERR_FULL;
  @ behavior refused:
  @   assumes scheduler != \null && task != \null && addable(scheduler, task);
  @   assumes !admits(scheduler, task);
  @   assigns \nothing;
  @   ensures SCH_005_refused: admission_status(\result);
  @   ensures SCH_005_rule: scheduler_holds(scheduler) ==> refuses(scheduler, task, \result);
  @ behavior added:
  @   assumes scheduler != \null && task != \null && addable(scheduler, task);
  @   assumes admits(scheduler, task);
  @   ensures ok: \result == KEEL_OK;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SCH_004_order: order_joined{Pre, Post}(&scheduler->queue, task->priority);
  @   ensures SCH_004_copied: slot_copied(&scheduler->queue,
  @       \old(scheduler->queue.order[scheduler->queue.count]), task);
  @   ensures SCH_004_fresh: \result == KEEL_OK ==> SLOT_FRESH(&scheduler->queue,
  @       \old(scheduler->queue.order[scheduler->queue.count]));
  @   ensures SCH_004_release:
  @       scheduler->queue.release_us[\old(scheduler->queue.order[scheduler->queue.count])] ==
  @       scheduler->clock.now_us + task->phase_us;
  @   ensures SCH_004_wake: nothing_known(scheduler);
  @   ensures SCH_004_running: running_joined{Pre, Post}(scheduler, task->priority);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_add(keel_scheduler_t *scheduler, const keel_task_config_t *task);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler));
  @ assigns scheduler->queue.count, scheduler->queue.realtime_count,
  @     scheduler->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns scheduler->cursor, scheduler->pass_end, scheduler->running, scheduler->wake_us,
  @     scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ behavior null:
  @   assumes scheduler == \null || task == \null;
  @   assigns \nothing;
  @   ensures SCH_008_null: \result == KEEL_ERR_NULL;
  @ behavior unknown:
  @   assumes scheduler != \null && task != \null && !queue_holds(&scheduler->queue, task);
  @   assigns \nothing;
  @   ensures SCH_008_unknown: \result == KEEL_ERR_UNKNOWN_TASK;
  @ behavior removed:
  @   assumes scheduler != \null && task != \null && queue_holds(&scheduler->queue, task);
  @   ensures ok: \result == KEEL_OK;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SCH_007_gone: !queue_holds(&scheduler->queue, task);
  @   ensures SCH_007_tasks: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @       \old(scheduler->queue.task[x]) != task ==>
  @       scheduler->queue.task[x] == \old(scheduler->queue.task[x]);
  @   ensures SCH_007_freed: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       scheduler->queue.task[\old(scheduler->queue.order[i])] == \null;
  @   ensures SCH_007_order: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       order_left{Pre, Post}(&scheduler->queue, i);
  @   ensures SCH_007_pass: \forall integer i; \old(is_at(scheduler, i, task)) ==>
  @       pass_left{Pre, Post}(scheduler, i);
  @   ensures SCH_007_wake: nothing_known(scheduler);
  @   ensures SCH_007_shrinks: scheduler->pass_end - scheduler->cursor <=
  @       \old(scheduler->pass_end - scheduler->cursor);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_remove(keel_scheduler_t *scheduler, const keel_task_config_t *task);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     clock_modelled(scheduler));
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->stage,
  @     scheduler->earliest_realtime_us;
  @ ensures SCH_010_kept: scheduler != \null && \result != KEEL_OK ==>
  @     started_nothing{Pre, Post}(scheduler);
  @ behavior null:
  @   assumes scheduler == \null;
  @   assigns \nothing;
  @   ensures SCH_010_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_SETUP;
  @   assigns \nothing;
  @   ensures SCH_010_state: \result == KEEL_ERR_STATE;
  @ behavior refused:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_SETUP;
  @   assumes !scheduler_holds(scheduler);
  @   assigns \nothing;
  @   ensures SCH_010_offender: \exists integer n; 0 <= n < scheduler->queue.count &&
  @       scheduler_holds_of(scheduler, n) && scheduler_refused(scheduler, n + 1, \result);
  @ behavior started:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_SETUP;
  @   assumes scheduler_holds(scheduler);
  @   ensures ok: \result == KEEL_OK;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SCH_009_stage: scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_009_clock: scheduler->clock.now_us == 0;
  @   ensures SCH_009_bound: scheduler->earliest_realtime_us == 0;
  @   ensures SCH_009_demand: \old(demand_admitted(&scheduler->queue, scheduler->config.guard_us));
  @   ensures SCH_009_gaps: \old(gaps_admitted(&scheduler->queue, scheduler->config.guard_us));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_start(keel_scheduler_t *scheduler);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     scheduler == running_scheduler && clock_modelled(scheduler) && bodies_modelled(scheduler));
  @ requires scheduler != \null ==> wake_right(scheduler) &&
  @     uptime_left(scheduler, scheduler->queue.realtime_count + 2) &&
  @     scheduler->busy_us <= scheduler->clock.now_us;
  @ assigns *scheduler;
  @ behavior null:
  @   assumes scheduler == \null;
  @   assigns \nothing;
  @   ensures SCH_020_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_READY;
  @   assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->wake_us,
  @       scheduler->stage, scheduler->cursor, scheduler->pass_end;
  @   ensures SCH_020_state: \result == KEEL_ERR_STATE;
  @   ensures SCH_020_kept: begun_nothing{Pre, Post}(scheduler);
  @ behavior ready:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_READY;
  @   SCHEDULER_STAYS_VALID(scheduler)
  @   ensures SCH_020_wake: wake_right(scheduler);
  @   ensures SCH_020_result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @   ensures SCH_020_closed: scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_020_time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us;
  @   ensures SCH_020_busy: scheduler->busy_us <= scheduler->clock.now_us;
  @   ensures SCH_020_served: \result == KEEL_OK ==> asked_us <= \old(scheduler->clock.now_us) ==>
  @       \forall integer i; 0 <= i < scheduler->pass_end ==>
  @           asked_us < scheduler->queue.release_us[scheduler->queue.order[i]];
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_step(keel_scheduler_t *scheduler);

/*@ requires scheduler == \null || (\valid_read(scheduler) && in_uptime(scheduler) &&
  @     clock_modelled(scheduler));
  @ assigns \nothing;
  @ behavior null:
  @   assumes scheduler == \null;
  @   ensures SCH_028_null: \result == 0;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_READY;
  @   ensures SCH_028_state: \result == 0;
  @ behavior ready:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_028_reading: \exists integer raw_us; 0 <= raw_us <= UINT32_MAX &&
  @       \result == \max(0, \min(longest_us, sleep_left(scheduler, raw_us, latency_us)));
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
uint32_t keel_scheduler_idle_us(const keel_scheduler_t *scheduler, uint32_t latency_us,
                                uint32_t longest_us);

/*@ requires scheduler == \null || (\valid(scheduler) && scheduler_valid(scheduler) &&
  @     clock_modelled(scheduler));
  @ assigns scheduler->clock.raw_us;
  @ behavior null:
  @   assumes scheduler == \null;
  @   assigns \nothing;
  @   ensures SCH_021_null: \result == KEEL_ERR_NULL;
  @ behavior state:
  @   assumes scheduler != \null && scheduler->stage != KEEL_STAGE_READY;
  @   assigns \nothing;
  @   ensures SCH_021_state: \result == KEEL_ERR_STATE;
  @ behavior ready:
  @   assumes scheduler != \null && scheduler->stage == KEEL_STAGE_READY;
  @   ensures SCH_021_taken: \result == KEEL_OK;
  @   ensures SCH_021_valid: scheduler_valid(scheduler);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_resync(keel_scheduler_t *scheduler);

/*@ requires scheduler == \null || (\valid_read(scheduler) && scheduler_valid(scheduler));
  @ assigns \nothing;
  @ ensures SCH_024_none: scheduler == \null || position >= scheduler->queue.count <==>
  @     \result == \null;
  @ ensures SCH_024_task: \result != \null ==>
  @     \result == scheduler->queue.task[scheduler->queue.order[position]];
  @*/
const keel_task_config_t *keel_scheduler_task(const keel_scheduler_t *scheduler, uint32_t position);

/*@ requires scheduler == \null || (\valid_read(scheduler) && scheduler_valid(scheduler));
  @ requires report == \null || \valid(report);
  @ requires scheduler != \null && report != \null ==> \separated(scheduler, report);
  @ assigns *report;
  @ behavior null:
  @   assumes scheduler == \null || task == \null || report == \null;
  @   assigns \nothing;
  @   ensures SCH_025_null: \result == KEEL_ERR_NULL;
  @ behavior unknown:
  @   assumes scheduler != \null && task != \null && report != \null;
  @   assumes !queue_holds(&scheduler->queue, task);
  @   assigns \nothing;
  @   ensures SCH_025_unknown: \result == KEEL_ERR_UNKNOWN_TASK;
  @ behavior known:
  @   assumes scheduler != \null && task != \null && report != \null;
  @   assumes queue_holds(&scheduler->queue, task);
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_025_report: \result == KEEL_OK ==>
  @       \forall integer i; is_at(scheduler, i, task) ==>
  @       report->release_us == scheduler->queue.release_us[scheduler->queue.order[i]] &&
  @       report->skipped == scheduler->queue.skipped[scheduler->queue.order[i]] &&
  @       report->stats == scheduler->queue.stats[scheduler->queue.order[i]];
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_scheduler_report(const keel_scheduler_t *scheduler,
                                    const keel_task_config_t *task, keel_task_report_t *report);

KEEL_C_END

#endif
