/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/pass.h
 * @brief A pass: the pieces that keel_scheduler_step is made of.
 *
 * Begin opens the pass, next decides and hands out the task to run, finish takes its statistics;
 * none of them calls a task. A turn is next, the body and finish; run takes turns until the pass is
 * closed, which is what follows begin in a step. Between two passes idle says how long a loop may
 * sleep. They take a scheduler that is not null.
 */
#ifndef KEEL_INTERNAL_RTOS_PASS_H
#define KEEL_INTERNAL_RTOS_PASS_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/scheduler_state.h"
#include "keel/internal/rtos/task.h"
#include "keel/rtos/clock.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/*
 * Assumptions on the functions that the user supplies, as contracts of two that stand for any.
 * They are only declared for the proofs; nobody defines or calls them.
 */

/* The scheduler that is running: any one. Nothing assigns it; it only exists in proofs. */
//@ ghost extern keel_scheduler_t *running_scheduler;

/* Any clock: it writes nothing that the kernel reads. */
/*@ assigns \nothing; */
uint32_t keel_any_clock(void *context);

/* Any moment: what is proved of it holds of each. Nothing assigns it; it only exists in proofs. */
//@ ghost extern uint64_t asked_us;

/*@ // Of the tasks that the pass has looked at none is left that was due at the moment asked about.
  @ predicate served(keel_scheduler_t *s) = \forall integer i; 0 <= i < s->cursor ==>
  @     asked_us < s->queue.release_us[s->queue.order[i]];
  @*/

/* Any body: of what the kernel reads it writes the scheduler alone, and that only through
 * keel_scheduler_add and keel_scheduler_remove, which keep these. */
/*@ requires \valid(running_scheduler) && scheduler_valid(running_scheduler);
  @ requires in_uptime(running_scheduler) && stage_running(running_scheduler);
  @ assigns *running_scheduler;
  @ SCHEDULER_STAYS_VALID(running_scheduler)
  @ ensures stage: running_scheduler->stage == \old(running_scheduler->stage);
  @ ensures now: running_scheduler->clock.now_us == \old(running_scheduler->clock.now_us);
  @ ensures busy: running_scheduler->busy_us == \old(running_scheduler->busy_us);
  @ ensures pass: running_scheduler->pass_end - running_scheduler->cursor <=
  @     \old(running_scheduler->pass_end - running_scheduler->cursor);
  @ ensures served: \old(served(running_scheduler)) ==> served(running_scheduler);
  @ ensures clock: running_scheduler->config.read_clock ==
  @     \old(running_scheduler->config.read_clock);
  @ ensures declared: \forall integer i; 0 <= i < running_scheduler->queue.count ==>
  @     \valid_read(running_scheduler->queue.task[running_scheduler->queue.order[i]]);
  @ ensures apart: \forall integer i; 0 <= i < running_scheduler->queue.count ==>
  @     \separated(running_scheduler,
  @                running_scheduler->queue.task[running_scheduler->queue.order[i]]);
  @ ensures bodies: \forall integer i; 0 <= i < running_scheduler->queue.count ==>
  @     running_scheduler->queue.task[running_scheduler->queue.order[i]]->run == &keel_any_body;
  @*/
void keel_any_body(void *context);

/*@ predicate clock_modelled(keel_scheduler_t *s) = s->config.read_clock == &keel_any_clock;
  @
  @ // Every task's declaration can be read, lies outside of the scheduler, and names a body.
  @ predicate bodies_modelled(keel_scheduler_t *s) =
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         \valid_read(s->queue.task[s->queue.order[i]])) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         \separated(s, s->queue.task[s->queue.order[i]])) &&
  @     (\forall integer i; 0 <= i < s->queue.count ==>
  @         s->queue.task[s->queue.order[i]]->run == &keel_any_body);
  @
  @ // The room for a pass' readings of the clock below the uptime's limit: one opens the pass, one
  @ // follows each real-time task that is left and one the last task.
  @ predicate uptime_left(keel_scheduler_t *s, integer readings) =
  @     s->clock.now_us + readings * KEEL_CLOCK_STEP_LIMIT_US <= KEEL_CLOCK_TIME_LIMIT_US;
  @*/

/*@ // All that beginning a step writes is the same in states L and M.
  @ predicate begun_nothing{L, M}(keel_scheduler_t *s) =
  @     \at(s->clock.now_us, M) == \at(s->clock.now_us, L) &&
  @     \at(s->clock.raw_us, M) == \at(s->clock.raw_us, L) &&
  @     \at(s->wake_us, M) == \at(s->wake_us, L) && \at(s->stage, M) == \at(s->stage, L) &&
  @     \at(s->cursor, M) == \at(s->cursor, L) && \at(s->pass_end, M) == \at(s->pass_end, L);
  @*/

/**
 * Begins a step: takes the time, and opens a pass unless nothing can be due (requirement SCH-011).
 * Inline, as a step that waits does little else.
 *
 * @param scheduler a started scheduler
 * @param raw_us    the clock now, at most 2^31 - 1 us after its last reading
 * @return KEEL_OK; KEEL_ERR_STATE when it is not started, or a pass is open; KEEL_ERR_CLOCK when
 *         the clock jumped backwards
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires wake_right(scheduler);
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->wake_us, scheduler->stage,
  @     scheduler->cursor, scheduler->pass_end;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_012_wake: wake_right(scheduler);
  @ ensures SCH_013_kept: \result != KEEL_OK ==> begun_nothing{Pre, Post}(scheduler);
  @ behavior state:
  @   assumes scheduler->stage != KEEL_STAGE_READY;
  @   assigns \nothing;
  @   ensures SCH_013_state: \result == KEEL_ERR_STATE;
  @ behavior backwards:
  @   assumes scheduler->stage == KEEL_STAGE_READY;
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) >= KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures SCH_013_clock: \result == KEEL_ERR_CLOCK;
  @ behavior forwards:
  @   assumes scheduler->stage == KEEL_STAGE_READY;
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) < KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_011_time: scheduler->clock.now_us == \old(scheduler->clock.now_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_011_raw: scheduler->clock.raw_us == raw_us;
  @   ensures SCH_011_opens: scheduler->stage == KEEL_STAGE_PASS <==>
  @       \old(scheduler->wake_us) <= scheduler->clock.now_us;
  @   ensures SCH_011_idle: scheduler->stage != KEEL_STAGE_PASS ==>
  @       scheduler->stage == KEEL_STAGE_READY && nothing_due(scheduler);
  @   ensures SCH_011_kept: scheduler->stage != KEEL_STAGE_PASS ==>
  @       scheduler->wake_us == \old(scheduler->wake_us) &&
  @       scheduler->cursor == \old(scheduler->cursor) &&
  @       scheduler->pass_end == \old(scheduler->pass_end);
  @   ensures SCH_011_open: scheduler->stage == KEEL_STAGE_PASS ==> scheduler->wake_us == 0 &&
  @       scheduler->cursor == 0 && scheduler->pass_end == scheduler->queue.realtime_count;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
static inline keel_status_t keel_pass_begin(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_READY) {
        return KEEL_ERR_STATE;
    }
    status = keel_clock_advance(&scheduler->clock, raw_us);
    if (status != KEEL_OK) {
        return status;
    }
    /*@ assert releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     scheduler->queue.release_us[x] == \at(scheduler->queue.release_us[x], Pre);
      @*/
    /*@ assert sooner: \forall integer j; 0 <= j < scheduler->queue.realtime_count ==>
      @     time_to(&scheduler->queue, scheduler->queue.order[j], scheduler->clock.now_us) <=
      @     \at(time_to(&scheduler->queue, scheduler->queue.order[j], scheduler->clock.now_us),
      @         Pre);
      @*/
    /*@ assert misfit: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
      @     !\at(fits_slack(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
      @                     scheduler->config.guard_us), Pre) ==>
      @     !fits_slack(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
      @                 scheduler->config.guard_us);
      @*/
    if (scheduler->clock.now_us < scheduler->wake_us) {
        /*@ assert same: scheduler->wake_us == \at(scheduler->wake_us, Pre) && \forall integer i;
          @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
          @     scheduler->queue.release_us[scheduler->queue.order[i]] ==
          @         \at(scheduler->queue.release_us[scheduler->queue.order[i]], Pre) &&
          @     promotion(&scheduler->queue, scheduler->queue.order[i]) ==
          @         \at(promotion(&scheduler->queue, scheduler->queue.order[i]), Pre);
          @*/
        /*@ assert waits: \forall integer i;
          @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
          @     \at(waits(scheduler, i), Pre) && waits(scheduler, i);
          @*/
        /*@ assert idle: \forall integer i;
          @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
          @     waits(scheduler, i) && !other_may_run(scheduler, i);
          @*/
        return KEEL_OK;
    }
    scheduler->wake_us = 0u;
    scheduler->stage = KEEL_STAGE_PASS;
    scheduler->cursor = 0;
    scheduler->pass_end = (int16_t)scheduler->queue.realtime_count;
    return KEEL_OK;
}

/**
 * Decides which task runs now and takes it into service: its release moves on along its grid
 * (requirements SCH-014 to SCH-016).
 *
 * @param scheduler a scheduler
 * @return the task, whose body the caller must run now and then call keel_pass_finish; null when
 *         the pass is over, or none is open
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires wake_right(scheduler);
  @ assigns scheduler->wake_us, scheduler->stage, scheduler->cursor, scheduler->running,
  @     scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ assigns scheduler->queue.skipped[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1].promotions;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_012_wake: wake_right(scheduler);
  @ ensures SCH_014_pass: scheduler->pass_end == \old(scheduler->pass_end);
  @ ensures SCH_014_time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @ behavior closed:
  @   assumes scheduler->stage != KEEL_STAGE_PASS;
  @   assigns \nothing;
  @   ensures SCH_014_closed: \result == \null;
  @ behavior open:
  @   assumes scheduler->stage == KEEL_STAGE_PASS;
  @   ensures SCH_015_ahead: \old(scheduler->cursor) <= scheduler->cursor;
  @   ensures SCH_014_stage: (\result == \null && scheduler->stage == KEEL_STAGE_READY) ||
  @       (\result != \null && stage_running(scheduler));
  @   ensures SCH_014_task: \result != \null ==> scheduler->running < scheduler->queue.count &&
  @       \result == scheduler->queue.task[scheduler->queue.order[scheduler->running]];
  @   ensures SCH_014_released: \result != \null ==>
  @       \at(due(scheduler, \at(scheduler->running, Post)), Pre);
  @   ensures SCH_014_moved: \result != \null ==>
  @       moved_on{Pre, Post}(scheduler, scheduler->running);
  @   ensures SCH_014_release: \result != \null ==> !due(scheduler, scheduler->running);
  @   ensures SCH_014_others: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
  @       \result == \null || k != scheduler->running ==>
  @       scheduler->queue.release_us[scheduler->queue.order[k]] ==
  @           \old(scheduler->queue.release_us[scheduler->queue.order[k]]);
  @   ensures SCH_014_uncounted: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
  @       \result == \null || k != scheduler->running ==>
  @       scheduler->queue.skipped[scheduler->queue.order[k]] ==
  @           \old(scheduler->queue.skipped[scheduler->queue.order[k]]);
  @   ensures SCH_015_realtime: scheduler->stage == KEEL_STAGE_REALTIME ==>
  @       \old(scheduler->cursor) <= scheduler->running < scheduler->pass_end &&
  @       scheduler->cursor == scheduler->running + 1;
  @   ensures SCH_015_first: scheduler->stage == KEEL_STAGE_REALTIME ==>
  @       \forall integer i; \old(scheduler->cursor) <= i < scheduler->running ==>
  @           !\old(due(scheduler, i));
  @   ensures SCH_015_bounds: scheduler->stage == KEEL_STAGE_REALTIME ==>
  @       scheduler->earliest_realtime_us == \old(scheduler->earliest_realtime_us) &&
  @       scheduler->earliest_other_us == \old(scheduler->earliest_other_us);
  @   ensures SCH_015_none: scheduler->stage != KEEL_STAGE_REALTIME ==>
  @       scheduler->cursor == scheduler->pass_end &&
  @       \forall integer i; \old(scheduler->cursor) <= i < scheduler->pass_end ==>
  @           !\old(due(scheduler, i));
  @   ensures SCH_016_class: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       scheduler->running >= scheduler->queue.realtime_count;
  @   ensures SCH_016_fits: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \at(other_may_run(scheduler, \at(scheduler->running, Post)), Pre);
  @   ensures SCH_016_highest: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @           \old(other_may_run(scheduler, i)) ==> \old(priority_at(scheduler, i)) <=
  @               \at(priority_at(scheduler, \at(scheduler->running, Post)), Pre);
  @   ensures SCH_016_first: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->running ==>
  @           \old(other_may_run(scheduler, i)) ==> \old(priority_at(scheduler, i)) <
  @               \at(priority_at(scheduler, \at(scheduler->running, Post)), Pre);
  @   ensures SCH_016_none: \result == \null ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @           !\old(other_may_run(scheduler, i));
  @   ensures SCH_016_promotion: scheduler->stage == KEEL_STAGE_OTHER ==>
  @       promotions_at(scheduler, scheduler->running) ==
  @           ((\at(priority_at(scheduler, \at(scheduler->running, Post)), Pre) ==
  @             KEEL_PRIORITY_REALTIME && scheduler->config.without_promotion == 0)
  @               ? counted(\at(promotions_at(scheduler, \at(scheduler->running, Post)), Pre),
  @                         UINT16_MAX)
  @               : \at(promotions_at(scheduler, \at(scheduler->running, Post)), Pre));
  @   ensures SCH_014_running: \result == \null ==> scheduler->running == \old(scheduler->running);
  @   ensures SCH_016_known: scheduler->stage != KEEL_STAGE_REALTIME ==>
  @       \at(is_earliest(&scheduler->queue, 0, scheduler->queue.realtime_count,
  @                       \at(scheduler->earliest_realtime_us, Post)), Pre);
  @   ensures SCH_016_bound: scheduler->stage != KEEL_STAGE_REALTIME ==>
  @       scheduler->clock.now_us < \old(scheduler->earliest_other_us) ==>
  @       scheduler->earliest_other_us == \old(scheduler->earliest_other_us);
  @   ensures SCH_016_renewed: scheduler->stage != KEEL_STAGE_REALTIME ==>
  @       \old(scheduler->earliest_other_us) <= scheduler->clock.now_us ==>
  @       \at(is_earliest(&scheduler->queue, scheduler->queue.realtime_count,
  @                       scheduler->queue.count, \at(scheduler->earliest_other_us, Post)), Pre);
  @   ensures SCH_016_unpromoted: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
  @       scheduler->stage != KEEL_STAGE_OTHER || k != scheduler->running ==>
  @       promotions_at(scheduler, k) == \old(promotions_at(scheduler, k));
  @   ensures SCH_012_pass: \result != \null ==> scheduler->wake_us == 0;
  @   ensures SCH_012_realtime: \result == \null ==>
  @       \forall integer i; 0 <= i < scheduler->queue.realtime_count ==>
  @           scheduler->wake_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
  @   ensures SCH_012_others: \result == \null ==>
  @       \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @           scheduler->wake_us <= next_event(&scheduler->queue, scheduler->queue.order[i],
  @                                            scheduler->clock.now_us,
  @                                            scheduler->config.without_promotion);
  @   ensures SCH_012_first: \result == \null ==>
  @       scheduler->wake_us <= scheduler->earliest_realtime_us;
  @   ensures SCH_012_ahead: \result == \null ==>
  @       scheduler->clock.now_us < scheduler->earliest_other_us ==> scheduler->wake_us ==
  @           \min(scheduler->earliest_realtime_us, scheduler->earliest_other_us);
  @   ensures SCH_012_exact: \result == \null ==>
  @       scheduler->earliest_other_us <= scheduler->clock.now_us ==>
  @       scheduler->wake_us == scheduler->earliest_realtime_us ||
  @       \exists integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count &&
  @           scheduler->wake_us == next_event(&scheduler->queue, scheduler->queue.order[i],
  @                                            scheduler->clock.now_us,
  @                                            scheduler->config.without_promotion);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
const keel_task_config_t *keel_pass_next(keel_scheduler_t *scheduler);

/**
 * Finishes the running task: takes the time, and records how long it ran (requirement SCH-017).
 * When the clock jumped backwards nothing is recorded, and the pass ends.
 *
 * @param scheduler a scheduler whose keel_pass_next has returned a task
 * @param raw_us    the clock now, at most 2^31 - 1 us after its last reading
 * @return KEEL_OK; KEEL_ERR_STATE when no task runs; KEEL_ERR_CLOCK
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->busy_us <= scheduler->clock.now_us;
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->busy_us, scheduler->stage,
  @     scheduler->running;
  @ assigns STATS_RUN(scheduler->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_017_busy_bound: scheduler->busy_us <= scheduler->clock.now_us;
  @ ensures SCH_017_pass: scheduler->cursor == \old(scheduler->cursor) &&
  @     scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->wake_us == \old(scheduler->wake_us);
  @ ensures SCH_017_declared: declared_same{Pre, Post}(scheduler);
  @ ensures SCH_017_releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     scheduler->queue.release_us[x] == \old(scheduler->queue.release_us[x]);
  @ behavior state:
  @   assumes !stage_running(scheduler);
  @   assigns \nothing;
  @   ensures SCH_018_state: \result == KEEL_ERR_STATE;
  @ behavior backwards:
  @   assumes stage_running(scheduler);
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) >= KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures SCH_018_clock: \result == KEEL_ERR_CLOCK;
  @   ensures SCH_018_time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @       scheduler->clock.raw_us == \old(scheduler->clock.raw_us) &&
  @       scheduler->busy_us == \old(scheduler->busy_us);
  @   ensures SCH_018_unrecorded: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @       stats_same{Pre, Post}(&scheduler->queue.stats[x]);
  @   ensures SCH_018_ends: scheduler->stage == KEEL_STAGE_READY &&
  @       scheduler->running == KEEL_POSITION_NONE;
  @ behavior forwards:
  @   assumes stage_running(scheduler);
  @   assumes clock_elapsed(scheduler->clock.raw_us, raw_us) < KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures ok: \result == KEEL_OK;
  @   ensures SCH_017_time: scheduler->clock.now_us == \old(scheduler->clock.now_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_017_raw: scheduler->clock.raw_us == raw_us;
  @   ensures SCH_017_busy: scheduler->busy_us == \old(scheduler->busy_us)
  @       + clock_elapsed(\old(scheduler->clock.raw_us), raw_us);
  @   ensures SCH_017_stage: scheduler->stage ==
  @       ((\old(scheduler->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @   ensures SCH_017_running: scheduler->running == KEEL_POSITION_NONE;
  @   ensures SCH_017_recorded: \old(scheduler->running) != KEEL_POSITION_NONE ==>
  @       stats_recorded{Pre, Post}(
  @           &scheduler->queue.stats[scheduler->queue.order[\old(scheduler->running)]],
  @           clock_elapsed(\old(scheduler->clock.raw_us), raw_us),
  @           scheduler->queue.budget_us[scheduler->queue.order[\old(scheduler->running)]]);
  @   ensures SCH_017_others: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @       \old(scheduler->running) == KEEL_POSITION_NONE ||
  @       x != scheduler->queue.order[\old(scheduler->running)] ==>
  @       stats_same{Pre, Post}(&scheduler->queue.stats[x]);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_pass_finish(keel_scheduler_t *scheduler, uint32_t raw_us);

/**
 * One turn of a pass (requirement SCH-026): next, and if it hands out a task, its body, and finish
 * with the clock as it reads then. Does nothing when no pass is open.
 *
 * @param scheduler a started scheduler, not from within a task
 * @return KEEL_OK, or KEEL_ERR_CLOCK when the clock jumped backwards, which ends the pass
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler == running_scheduler && clock_modelled(scheduler) &&
  @     bodies_modelled(scheduler);
  @ requires wake_right(scheduler) && scheduler->busy_us <= scheduler->clock.now_us;
  @ requires scheduler->stage == KEEL_STAGE_PASS ==> uptime_left(scheduler, 1);
  @ assigns *scheduler;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_026_wake: wake_right(scheduler);
  @ ensures SCH_026_clock: clock_modelled(scheduler);
  @ ensures SCH_026_bodies: bodies_modelled(scheduler);
  @ behavior closed:
  @   assumes scheduler->stage != KEEL_STAGE_PASS;
  @   ensures SCH_026_closed: \result == KEEL_OK;
  @ behavior open:
  @   assumes scheduler->stage == KEEL_STAGE_PASS;
  @   ensures SCH_026_result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @   ensures SCH_026_stage: scheduler->stage == KEEL_STAGE_READY ||
  @       (scheduler->stage == KEEL_STAGE_PASS && \result == KEEL_OK);
  @   ensures SCH_026_time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us <
  @       \old(scheduler->clock.now_us) + KEEL_CLOCK_STEP_LIMIT_US;
  @   ensures SCH_026_busy: scheduler->busy_us <= scheduler->clock.now_us;
  @   ensures SCH_026_shorter: scheduler->stage == KEEL_STAGE_PASS ==>
  @       scheduler->pass_end - scheduler->cursor <
  @       \old(scheduler->pass_end - scheduler->cursor);
  @   ensures SCH_026_looked: \result == KEEL_OK ==> scheduler->stage == KEEL_STAGE_READY ==>
  @       scheduler->cursor == scheduler->pass_end;
  @   ensures SCH_026_served: asked_us <= \old(scheduler->clock.now_us) ==>
  @       \old(served(scheduler)) ==> served(scheduler);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_pass_turn(keel_scheduler_t *scheduler);

/**
 * Runs the pass that keel_pass_begin has opened to its end (requirement SCH-023): turn after turn.
 * Does nothing when none is open.
 *
 * @param scheduler a started scheduler, not from within a task
 * @return KEEL_OK, or KEEL_ERR_CLOCK when the clock jumped backwards: see keel_scheduler_resync
 */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler == running_scheduler && clock_modelled(scheduler) &&
  @     bodies_modelled(scheduler);
  @ requires wake_right(scheduler) && scheduler->busy_us <= scheduler->clock.now_us;
  @ requires scheduler->stage == KEEL_STAGE_READY || scheduler->stage == KEEL_STAGE_PASS;
  @ requires scheduler->stage == KEEL_STAGE_PASS ==>
  @     uptime_left(scheduler, scheduler->pass_end - scheduler->cursor + 1);
  @ assigns *scheduler;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures SCH_023_wake: wake_right(scheduler);
  @ ensures SCH_023_result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @ ensures SCH_023_closed: scheduler->stage == KEEL_STAGE_READY;
  @ ensures SCH_023_time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us;
  @ ensures SCH_023_busy: scheduler->busy_us <= scheduler->clock.now_us;
  @ ensures SCH_023_clock: clock_modelled(scheduler);
  @ ensures SCH_023_bodies: bodies_modelled(scheduler);
  @ ensures SCH_023_looked: \result == KEEL_OK ==> \old(scheduler->stage) == KEEL_STAGE_PASS ==>
  @     scheduler->cursor == scheduler->pass_end;
  @ ensures SCH_023_served: asked_us <= \old(scheduler->clock.now_us) ==>
  @     \old(served(scheduler)) ==> served(scheduler);
  @*/
keel_status_t keel_pass_run(keel_scheduler_t *scheduler);

/*@ // Nothing can be due before it, and the counter tells any time up to it from a step backwards.
  @ logic integer sleep_end(keel_scheduler_t *s) =
  @     \min(s->wake_us, s->clock.now_us + KEEL_CLOCK_STEP_LIMIT_US - 1);
  @
  @ // The time left until then at a reading of the clock, behind the time that waking takes.
  @ logic integer sleep_left(keel_scheduler_t *s, integer raw_us, integer latency_us) =
  @     sleep_end(s) - s->clock.now_us - clock_elapsed(s->clock.raw_us, raw_us) - latency_us;
  @*/

/**
 * How long a loop may sleep before its next step (requirement SCH-027): until then no task can run,
 * and a step that reads the clock no more than the latency later begins no later than a release.
 *
 * @param scheduler  a scheduler
 * @param raw_us     the clock now
 * @param latency_us how long after the sleep the next step reads the clock, at most
 * @param longest_us what the sleep may last at most, for a watchdog that must be fed
 * @return how long, in us from that reading on; 0 when a task may be due within the latency, while
 *         a pass is open, before the start, and when the clock jumped backwards
 */
/*@ requires \valid_read(scheduler) && in_uptime(scheduler);
  @ assigns \nothing;
  @ ensures SCH_027_idle: \result == ((scheduler->stage == KEEL_STAGE_READY)
  @     ? \max(0, \min(longest_us, sleep_left(scheduler, raw_us, latency_us))) : 0);
  @*/
uint32_t keel_pass_idle_us(const keel_scheduler_t *scheduler, uint32_t raw_us, uint32_t latency_us,
                           uint32_t longest_us);

KEEL_C_END

#endif
