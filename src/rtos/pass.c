/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/pass.h"

#include "keel/internal/rtos/decision.h"
#include "keel/internal/rtos/queue.h"
#include "keel/internal/rtos/stats.h"

#include <stdbool.h>
#include <stddef.h>

/* Takes the task at a position into service: its next release, and what finish has to know. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires position < scheduler->queue.count && due(scheduler, position);
  @ requires scheduler->stage == KEEL_STAGE_PASS && cursor <= scheduler->pass_end;
  @ requires stage == KEEL_STAGE_REALTIME || stage == KEEL_STAGE_OTHER;
  @ assigns scheduler->cursor, scheduler->running, scheduler->stage,
  @     scheduler->queue.skipped[scheduler->queue.order[position]],
  @     scheduler->queue.release_us[scheduler->queue.order[position]];
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures task: \result == scheduler->queue.task[scheduler->queue.order[position]];
  @ ensures some: \result != \null;
  @ ensures running: scheduler->running == position && scheduler->stage == stage &&
  @     scheduler->cursor == cursor;
  @ ensures moved: moved_on{Pre, Post}(scheduler, position);
  @ ensures release: !due(scheduler, position);
  @ ensures others: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==> k != position ==>
  @     left_alone{Pre, Post}(scheduler, k);
  @*/
static const keel_task_config_t *dispatch_task(keel_scheduler_t *scheduler, uint32_t position,
                                               uint32_t cursor, int16_t stage)
{
    const uint32_t slot = scheduler->queue.order[position];

    keel_queue_advance(&scheduler->queue, slot, scheduler->clock.now_us);
    /*@ assert others: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==> k != position ==>
      @     left_alone{Pre, Here}(scheduler, k);
      @*/
    scheduler->cursor = (int16_t)cursor;
    scheduler->running = (int16_t)position;
    scheduler->stage = stage;
    return scheduler->queue.task[slot];
}

/* The position of the first due real-time task that the pass has yet to look at, or its end. Looks
 * at none of them while the earliest of their releases lies ahead. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ assigns \nothing;
  @ ensures range: scheduler->cursor <= \result <= scheduler->pass_end;
  @ ensures due: \result < scheduler->pass_end ==> due(scheduler, \result);
  @ ensures first: \forall integer i; scheduler->cursor <= i < \result ==> !due(scheduler, i);
  @*/
static uint32_t find_realtime(const keel_scheduler_t *scheduler)
{
    if (scheduler->clock.now_us < scheduler->earliest_realtime_us) {
        return (uint32_t)scheduler->pass_end;
    }
    return keel_decision_realtime(&scheduler->queue, (uint32_t)scheduler->cursor,
                                  (uint32_t)scheduler->pass_end, scheduler->clock.now_us);
}

/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler);
  @ assigns \nothing;
  @ ensures is_earliest(&scheduler->queue, 0, scheduler->queue.realtime_count, \result);
  @*/
static uint64_t find_earliest_realtime(const keel_scheduler_t *scheduler)
{
    if (scheduler->clock.now_us < scheduler->earliest_realtime_us) {
        return scheduler->earliest_realtime_us;
    }
    return keel_decision_earliest_us(&scheduler->queue);
}

/* The other task that runs now that no real-time task is due. Looks at none while the earliest
 * of their releases lies ahead. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires is_earliest(&scheduler->queue, 0, scheduler->queue.realtime_count, realtime_us);
  @ assigns \nothing;
  @ ensures range: \result.priority <= KEEL_PRIORITY_REALTIME;
  @ ensures bound: \forall integer i;
  @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     \result.earliest_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
  @ ensures known: scheduler->clock.now_us < scheduler->earliest_other_us ==>
  @     \result.earliest_us == scheduler->earliest_other_us;
  @ ensures renewed: scheduler->earliest_other_us <= scheduler->clock.now_us ==>
  @     is_earliest(&scheduler->queue, scheduler->queue.realtime_count, scheduler->queue.count,
  @                 \result.earliest_us);
  @ ensures chosen: \result.priority > 0 ==>
  @     scheduler->queue.realtime_count <= \result.position < scheduler->queue.count;
  @ ensures may: \result.priority > 0 ==> other_may_run(scheduler, \result.position);
  @ ensures priority: \result.priority > 0 ==>
  @     \result.priority == priority_at(scheduler, \result.position);
  @ ensures highest: \forall integer i;
  @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     other_may_run(scheduler, i) ==> priority_at(scheduler, i) <= \result.priority;
  @ ensures first: \result.priority > 0 ==> \forall integer i;
  @     scheduler->queue.realtime_count <= i < \result.position ==>
  @     other_may_run(scheduler, i) ==> priority_at(scheduler, i) < \result.priority;
  @ ensures none: \result.priority == 0 ==> \forall integer i;
  @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     !other_may_run(scheduler, i);
  @*/
static keel_choice_t choose_other(const keel_scheduler_t *scheduler, uint64_t realtime_us)
{
    const uint64_t now_us = scheduler->clock.now_us;
    const keel_choice_t none = {scheduler->earliest_other_us, 0u, 0u};
    uint32_t room_us;

    if (now_us < scheduler->earliest_other_us) {
        return none;
    }
    room_us = keel_decision_room_us(realtime_us, now_us, scheduler->config.guard_us);
    /*@ assert least: \forall integer j; 0 <= j < scheduler->queue.realtime_count ==>
      @     ((realtime_us > now_us) ? realtime_us - now_us : 0) <=
      @         time_to(&scheduler->queue, scheduler->queue.order[j], now_us);
      @*/
    /*@ assert reached: realtime_us == KEEL_TIME_NEVER_US ||
      @     \exists integer j; 0 <= j < scheduler->queue.realtime_count &&
      @     ((realtime_us > now_us) ? realtime_us - now_us : 0) ==
      @         time_to(&scheduler->queue, scheduler->queue.order[j], now_us);
      @*/
    /*@ assert room: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
      @     (fits_slack(&scheduler->queue, scheduler->queue.order[i], now_us,
      @                 scheduler->config.guard_us) <==>
      @      task_worst(&scheduler->queue, scheduler->queue.order[i]) <= room_us);
      @*/
    return keel_decision_other(&scheduler->queue, now_us, room_us,
                               scheduler->config.without_promotion);
}

/* Remembers the earliest releases that a decision has found. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires is_earliest(&scheduler->queue, 0, scheduler->queue.realtime_count, realtime_us);
  @ requires \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     other_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
  @ assigns scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures realtime: scheduler->earliest_realtime_us == realtime_us;
  @ ensures other: scheduler->earliest_other_us == other_us;
  @ ensures releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     scheduler->queue.release_us[x] == \old(scheduler->queue.release_us[x]);
  @ ensures time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->wake_us == \old(scheduler->wake_us);
  @*/
static void remember_earliest(keel_scheduler_t *scheduler, uint64_t realtime_us, uint64_t other_us)
{
    scheduler->earliest_realtime_us = realtime_us;
    scheduler->earliest_other_us = other_us;
}

/* Takes the chosen task into service, and counts its promotion. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->stage == KEEL_STAGE_PASS;
  @ requires scheduler->queue.realtime_count <= position < scheduler->queue.count;
  @ requires due(scheduler, position);
  @ assigns scheduler->cursor, scheduler->running, scheduler->stage,
  @     scheduler->queue.skipped[scheduler->queue.order[position]],
  @     scheduler->queue.release_us[scheduler->queue.order[position]],
  @     scheduler->queue.stats[scheduler->queue.order[position]].promotions;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures task: \result == scheduler->queue.task[scheduler->queue.order[position]];
  @ ensures some: \result != \null;
  @ ensures running: scheduler->running == position && scheduler->stage == KEEL_STAGE_OTHER &&
  @     scheduler->cursor == scheduler->pass_end;
  @ ensures moved: moved_on{Pre, Post}(scheduler, position);
  @ ensures release: !due(scheduler, position);
  @ ensures others: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==> k != position ==>
  @     left_alone{Pre, Post}(scheduler, k);
  @ ensures promotion: promotions_at(scheduler, position) == ((by_promotion != 0)
  @     ? counted(\old(promotions_at(scheduler, position)), UINT16_MAX)
  @     : \old(promotions_at(scheduler, position)));
  @ ensures unpromoted: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==> k != position ==>
  @     promotions_at(scheduler, k) == \old(promotions_at(scheduler, k));
  @*/
static const keel_task_config_t *serve_other(keel_scheduler_t *scheduler, uint32_t position,
                                             bool by_promotion)
{
    if (by_promotion) {
        keel_stats_promote(&scheduler->queue.stats[scheduler->queue.order[position]]);
    }
    /*@ assert unpromoted: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==> k != position ==>
      @     promotions_at(scheduler, k) == \at(promotions_at(scheduler, k), Pre);
      @*/
    //@ assert state: scheduler_state(scheduler);
    return dispatch_task(scheduler, position, (uint32_t)scheduler->pass_end, KEEL_STAGE_OTHER);
}

/* Until when nothing can run that may not run now: an other task's release or promotion, or the
 * earliest real-time release. */
/*@ requires \valid_read(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     other_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
  @ assigns \nothing;
  @ ensures realtime: \result <= realtime_us;
  @ ensures others: \forall integer i;
  @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> \result <=
  @     next_event(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
  @                scheduler->config.without_promotion);
  @ ensures ahead: scheduler->clock.now_us < other_us ==>
  @     \result == \min(realtime_us, other_us);
  @ ensures exact: other_us <= scheduler->clock.now_us ==> \result == realtime_us ||
  @     \exists integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count &&
  @         \result == next_event(&scheduler->queue, scheduler->queue.order[i],
  @                               scheduler->clock.now_us, scheduler->config.without_promotion);
  @*/
static uint64_t find_wake(const keel_scheduler_t *scheduler, uint64_t realtime_us,
                          uint64_t other_us)
{
    uint64_t wake_us = other_us;

    if (wake_us <= scheduler->clock.now_us) {
        wake_us = keel_decision_event_us(&scheduler->queue, scheduler->clock.now_us,
                                         scheduler->config.without_promotion);
    }
    return (realtime_us < wake_us) ? realtime_us : wake_us;
}

/* Ends a pass in which nothing is left to run, and sets the wake-up time. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->stage == KEEL_STAGE_PASS;
  @ requires is_earliest(&scheduler->queue, 0, scheduler->queue.realtime_count, realtime_us);
  @ requires \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     other_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
  @ requires \forall integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count ==>
  @     !other_may_run(scheduler, i);
  @ assigns scheduler->earliest_realtime_us, scheduler->earliest_other_us, scheduler->wake_us,
  @     scheduler->cursor, scheduler->stage;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures wake: wake_right(scheduler);
  @ ensures stage: scheduler->stage == KEEL_STAGE_READY && scheduler->cursor == scheduler->pass_end;
  @ ensures realtime: wake_realtime(scheduler);
  @ ensures others: \forall integer i;
  @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> scheduler->wake_us <=
  @     next_event(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
  @                scheduler->config.without_promotion);
  @ ensures first: scheduler->wake_us <= realtime_us;
  @ ensures ahead: scheduler->clock.now_us < other_us ==>
  @     scheduler->wake_us == \min(realtime_us, other_us);
  @ ensures exact: other_us <= scheduler->clock.now_us ==> scheduler->wake_us == realtime_us ||
  @     \exists integer i; scheduler->queue.realtime_count <= i < scheduler->queue.count &&
  @         scheduler->wake_us == next_event(&scheduler->queue, scheduler->queue.order[i],
  @                                          scheduler->clock.now_us,
  @                                          scheduler->config.without_promotion);
  @ ensures known: scheduler->earliest_realtime_us == realtime_us &&
  @     scheduler->earliest_other_us == other_us;
  @ ensures releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     scheduler->queue.release_us[x] == \old(scheduler->queue.release_us[x]);
  @*/
static void close_pass(keel_scheduler_t *scheduler, uint64_t realtime_us, uint64_t other_us)
{
    const uint64_t wake_us = find_wake(scheduler, realtime_us, other_us);

    remember_earliest(scheduler, realtime_us, other_us);
    scheduler->wake_us = wake_us;
    scheduler->cursor = scheduler->pass_end;
    scheduler->stage = KEEL_STAGE_READY;
    /*@ assert releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     scheduler->queue.release_us[x] == \at(scheduler->queue.release_us[x], Pre);
      @*/
    /*@ assert times: \forall integer j; 0 <= j < scheduler->queue.realtime_count ==>
      @     time_to(&scheduler->queue, scheduler->queue.order[j], scheduler->clock.now_us) ==
      @     \at(time_to(&scheduler->queue, scheduler->queue.order[j], scheduler->clock.now_us),
      @         Pre);
      @*/
    /*@ assert misfits: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> due(scheduler, i) ==>
      @     !\at(other_may_run(scheduler, i), Pre) &&
      @     !\at(fits_slack(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
      @                     scheduler->config.guard_us), Pre);
      @*/
    /*@ assert misfit: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> due(scheduler, i) ==>
      @     !fits_slack(&scheduler->queue, scheduler->queue.order[i], scheduler->clock.now_us,
      @                 scheduler->config.guard_us);
      @*/
    //@ assert realtime: wake_realtime(scheduler);
    /*@ assert ahead: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> !due(scheduler, i) ==>
      @     scheduler->wake_us <= scheduler->queue.release_us[scheduler->queue.order[i]];
      @*/
    /*@ assert unpromoted: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> due(scheduler, i) ==>
      @     scheduler->config.without_promotion != 0 ||
      @     scheduler->wake_us <= promotion(&scheduler->queue, scheduler->queue.order[i]);
      @*/
    /*@ assert waits: \forall integer i;
      @     scheduler->queue.realtime_count <= i < scheduler->queue.count ==> waits(scheduler, i);
      @*/
    //@ assert others: wake_others(scheduler);
}

/* Where release and period are the same, so is what is left of the grid. */
/*@ lemma grid_same{L, M}: \forall keel_queue_t *q, integer x, integer now_us;
  @     \at(q->release_us[x], L) == \at(q->release_us[x], M) ==>
  @     \at(q->period_us[x], L) == \at(q->period_us[x], M) ==>
  @     \at(grid_missed(q, x, now_us), L) == \at(grid_missed(q, x, now_us), M) &&
  @     \at(grid_next(q, x, now_us), L) == \at(grid_next(q, x, now_us), M);
  @*/

const keel_task_config_t *keel_pass_next(keel_scheduler_t *scheduler)
{
    uint64_t realtime_us;
    const keel_task_config_t *task;
    keel_choice_t choice;
    uint32_t position;

    if (scheduler->stage != KEEL_STAGE_PASS) {
        return NULL;
    }
    position = find_realtime(scheduler);
    if (position < (uint32_t)scheduler->pass_end) {
        return dispatch_task(scheduler, position, position + 1u, KEEL_STAGE_REALTIME);
    }
    realtime_us = find_earliest_realtime(scheduler);
    choice = choose_other(scheduler, realtime_us);
    if (choice.priority == 0u) {
        close_pass(scheduler, realtime_us, choice.earliest_us);
        return NULL;
    }
    remember_earliest(scheduler, realtime_us, choice.earliest_us);
    /*@ assert same: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
      @     left_alone{Pre, Here}(scheduler, k);
      @*/
    /*@ assert next: \forall integer k; 0 <= k < scheduler->queue.count ==>
      @     grid_next(&scheduler->queue, scheduler->queue.order[k], scheduler->clock.now_us) ==
      @     \at(grid_next(&scheduler->queue, scheduler->queue.order[k],
      @                   scheduler->clock.now_us), Pre);
      @*/
    /*@ assert missed: \forall integer k; 0 <= k < scheduler->queue.count ==>
      @     grid_missed(&scheduler->queue, scheduler->queue.order[k], scheduler->clock.now_us) ==
      @     \at(grid_missed(&scheduler->queue, scheduler->queue.order[k],
      @                     scheduler->clock.now_us), Pre);
      @*/
    task = serve_other(scheduler, choice.position,
                       (choice.priority == KEEL_PRIORITY_REALTIME) &&
                           !scheduler->config.without_promotion);
    /*@ assert others: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
      @     k != scheduler->running ==> left_alone{Pre, Here}(scheduler, k);
      @*/
    /*@ assert time: scheduler->clock.now_us == \at(scheduler->clock.now_us, Pre) &&
      @     scheduler->busy_us == \at(scheduler->busy_us, Pre);
      @*/
    /*@ assert uncounted: \forall integer k; 0 <= k < KEEL_QUEUE_CAPACITY ==>
      @     k != scheduler->running ==> scheduler->queue.skipped[scheduler->queue.order[k]] ==
      @         \at(scheduler->queue.skipped[scheduler->queue.order[k]], Pre);
      @*/
    return task;
}

/* Ends the run of a task: takes the time and counts it as busy; the pass goes on after a real-time
 * task, unless the clock is broken, which the caller learns. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler->busy_us <= scheduler->clock.now_us && stage_running(scheduler);
  @ assigns scheduler->clock.now_us, scheduler->clock.raw_us, scheduler->busy_us, scheduler->stage,
  @     scheduler->running;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures result: \result == ((clock_elapsed(\old(scheduler->clock.raw_us), raw_us) <
  @     KEEL_CLOCK_STEP_LIMIT_US) ? KEEL_OK : KEEL_ERR_CLOCK);
  @ ensures time: scheduler->clock.now_us == \old(scheduler->clock.now_us) +
  @     ((\result == KEEL_OK) ? clock_elapsed(\old(scheduler->clock.raw_us), raw_us) : 0);
  @ ensures raw: scheduler->clock.raw_us ==
  @     ((\result == KEEL_OK) ? raw_us : \old(scheduler->clock.raw_us));
  @ ensures busy: scheduler->busy_us == \old(scheduler->busy_us) +
  @     scheduler->clock.now_us - \old(scheduler->clock.now_us);
  @ ensures stage: scheduler->stage == ((\result == KEEL_OK &&
  @     \old(scheduler->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @ ensures running: scheduler->running == KEEL_POSITION_NONE;
  @ ensures declared: declared_same{Pre, Post}(scheduler);
  @ ensures releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     scheduler->queue.release_us[x] == \old(scheduler->queue.release_us[x]);
  @*/
static keel_status_t end_run(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const bool realtime = scheduler->stage == KEEL_STAGE_REALTIME;
    const keel_status_t status = keel_clock_advance(&scheduler->clock, raw_us);

    scheduler->stage = ((status == KEEL_OK) && realtime) ? KEEL_STAGE_PASS : KEEL_STAGE_READY;
    scheduler->running = KEEL_POSITION_NONE;
    scheduler->busy_us += scheduler->clock.now_us - start_us;
    return status;
}

/* Records in the statistics of the task at a position how long it ran. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler);
  @ requires position < scheduler->queue.count;
  @ assigns STATS_RUN(scheduler->queue.stats[scheduler->queue.order[position]]);
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures recorded: stats_recorded{Pre, Post}(
  @     &scheduler->queue.stats[scheduler->queue.order[position]], ran_us,
  @     scheduler->queue.budget_us[scheduler->queue.order[position]]);
  @ ensures others: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     x != scheduler->queue.order[position] ==>
  @     stats_same{Pre, Post}(&scheduler->queue.stats[x]);
  @ ensures releases: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @     scheduler->queue.release_us[x] == \old(scheduler->queue.release_us[x]);
  @ ensures declared: declared_same{Pre, Post}(scheduler);
  @ ensures clock: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->clock.raw_us == \old(scheduler->clock.raw_us);
  @ ensures pass: scheduler->cursor == \old(scheduler->cursor) &&
  @     scheduler->pass_end == \old(scheduler->pass_end) &&
  @     scheduler->wake_us == \old(scheduler->wake_us);
  @ ensures state: scheduler->stage == \old(scheduler->stage) &&
  @     scheduler->running == \old(scheduler->running) &&
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @*/
static void record_run(keel_scheduler_t *scheduler, uint32_t position, uint32_t ran_us)
{
    const uint32_t slot = scheduler->queue.order[position];

    keel_stats_record(&scheduler->queue.stats[slot], ran_us, scheduler->queue.budget_us[slot]);
}

keel_status_t keel_pass_finish(keel_scheduler_t *scheduler, uint32_t raw_us)
{
    const uint64_t start_us = scheduler->clock.now_us;
    const int16_t position = scheduler->running;
    keel_status_t status;

    if ((scheduler->stage != KEEL_STAGE_REALTIME) && (scheduler->stage != KEEL_STAGE_OTHER)) {
        return KEEL_ERR_STATE;
    }
    status = end_run(scheduler, raw_us);
    /*@ assert unrecorded: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     stats_same{Pre, Here}(&scheduler->queue.stats[x]);
      @*/
    if ((status == KEEL_OK) && (position != KEEL_POSITION_NONE)) {
        const uint32_t ran_us = (uint32_t)(scheduler->clock.now_us - start_us);

        record_run(scheduler, (uint32_t)position, ran_us);
        /*@ assert others: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
          @     x != scheduler->queue.order[position] ==>
          @     stats_same{Pre, Here}(&scheduler->queue.stats[x]);
          @*/
    }
    return status;
}

/* Runs the body of a task that was taken into service, and finishes it. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires scheduler == running_scheduler && clock_modelled(scheduler) &&
  @     bodies_modelled(scheduler);
  @ requires stage_running(scheduler) && \valid_read(task) && task->run == &keel_any_body;
  @ requires scheduler->busy_us <= scheduler->clock.now_us;
  @ requires uptime_left(scheduler, 1);
  @ assigns *scheduler;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures awake: wake_right(scheduler);
  @ ensures result: \result == KEEL_OK || \result == KEEL_ERR_CLOCK;
  @ ensures stage: scheduler->stage == ((\result == KEEL_OK &&
  @     \old(scheduler->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @ ensures time: \old(scheduler->clock.now_us) <= scheduler->clock.now_us <
  @     \old(scheduler->clock.now_us) + KEEL_CLOCK_STEP_LIMIT_US;
  @ ensures busy: scheduler->busy_us <= scheduler->clock.now_us;
  @ ensures pass: scheduler->pass_end - scheduler->cursor <=
  @     \old(scheduler->pass_end - scheduler->cursor);
  @ ensures served: \old(served(scheduler)) ==> served(scheduler);
  @ ensures clock: clock_modelled(scheduler);
  @ ensures bodies: bodies_modelled(scheduler);
  @*/
static keel_status_t run_task(keel_scheduler_t *scheduler, const keel_task_config_t *task)
{
    uint32_t raw_us;

    //@ calls keel_any_body;
    task->run(task->context);
    //@ assert awake: scheduler->wake_us == 0;
    //@ calls keel_any_clock;
    raw_us = scheduler->config.read_clock(scheduler->config.clock_context);
    //@ assert elapsed: 0 <= clock_elapsed(scheduler->clock.raw_us, raw_us);
    return keel_pass_finish(scheduler, raw_us);
}

/* The next decision, as far as a turn of a pass rests on it. */
/*@ requires \valid(scheduler) && scheduler_valid(scheduler) && in_uptime(scheduler);
  @ requires wake_right(scheduler) && bodies_modelled(scheduler);
  @ assigns scheduler->wake_us, scheduler->stage, scheduler->cursor, scheduler->running,
  @     scheduler->earliest_realtime_us, scheduler->earliest_other_us;
  @ assigns scheduler->queue.skipped[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     scheduler->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1].promotions;
  @ SCHEDULER_STAYS_VALID(scheduler)
  @ ensures wake: wake_right(scheduler);
  @ ensures time: scheduler->clock.now_us == \old(scheduler->clock.now_us) &&
  @     scheduler->busy_us == \old(scheduler->busy_us);
  @ ensures bodies: bodies_modelled(scheduler);
  @ ensures task: \result != \null ==> \valid_read(\result) && \result->run == &keel_any_body;
  @ ensures open: \result != \null ==>
  @     \old(scheduler->stage) == KEEL_STAGE_PASS && stage_running(scheduler);
  @ ensures over: \old(scheduler->stage) == KEEL_STAGE_PASS ==> \result == \null ==>
  @     scheduler->stage == KEEL_STAGE_READY;
  @ ensures ahead: scheduler->stage == KEEL_STAGE_REALTIME ==> \result != \null ==>
  @     scheduler->pass_end - scheduler->cursor < \old(scheduler->pass_end - scheduler->cursor);
  @ ensures end: \old(scheduler->stage) == KEEL_STAGE_PASS ==>
  @     scheduler->stage != KEEL_STAGE_REALTIME ==> scheduler->cursor == scheduler->pass_end;
  @ ensures served: \old(scheduler->stage) == KEEL_STAGE_PASS ==>
  @     asked_us <= \old(scheduler->clock.now_us) ==> \old(served(scheduler)) ==>
  @     served(scheduler);
  @*/
static const keel_task_config_t *decide_turn(keel_scheduler_t *scheduler)
{
    const keel_task_config_t *const task = keel_pass_next(scheduler);

    /*@ assert waits: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==>
      @     \forall integer i; \at(scheduler->cursor, Pre) <= i < scheduler->cursor ==>
      @     task == \null || i != scheduler->running ==> \at(!due(scheduler, i), Pre);
      @*/
    /*@ assert later: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==>
      @     \forall integer i; \at(scheduler->cursor, Pre) <= i < scheduler->cursor ==>
      @     task == \null || i != scheduler->running ==>
      @         \at(scheduler->clock.now_us <
      @             scheduler->queue.release_us[scheduler->queue.order[i]], Pre);
      @*/
    //@ assert now: scheduler->clock.now_us == \at(scheduler->clock.now_us, Pre);
    /*@ assert same: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==>
      @     \forall integer i; 0 <= i < scheduler->cursor ==>
      @     task == \null || i != scheduler->running ==>
      @         scheduler->queue.release_us[scheduler->queue.order[i]] ==
      @             \at(scheduler->queue.release_us[scheduler->queue.order[i]], Pre);
      @*/
    /*@ assert skipped: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==>
      @     \forall integer i; \at(scheduler->cursor, Pre) <= i < scheduler->cursor ==>
      @     task == \null || i != scheduler->running ==>
      @         scheduler->clock.now_us < scheduler->queue.release_us[scheduler->queue.order[i]];
      @*/
    /*@ assert behind: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==> task != \null ==>
      @     scheduler->clock.now_us <
      @         scheduler->queue.release_us[scheduler->queue.order[scheduler->running]];
      @*/
    /*@ assert before: \at(scheduler->stage, Pre) == KEEL_STAGE_PASS ==>
      @     asked_us <= scheduler->clock.now_us ==> \at(served(scheduler), Pre) ==>
      @     \forall integer i; 0 <= i < \at(scheduler->cursor, Pre) ==>
      @         asked_us < scheduler->queue.release_us[scheduler->queue.order[i]];
      @*/
    return task;
}

keel_status_t keel_pass_turn(keel_scheduler_t *scheduler)
{
    const keel_task_config_t *const task = decide_turn(scheduler);

    if (task == NULL) {
        return KEEL_OK;
    }
    return run_task(scheduler, task);
}

keel_status_t keel_pass_run(keel_scheduler_t *scheduler)
{
    keel_status_t status;

    if (scheduler->stage != KEEL_STAGE_PASS) {
        return KEEL_OK;
    }
    /*@ loop invariant same: scheduler == running_scheduler && scheduler == \at(scheduler, Pre);
      @ loop invariant memory: \valid(scheduler);
      @ loop invariant valid: scheduler_valid(scheduler);
      @ loop invariant uptime: in_uptime(scheduler);
      @ loop invariant wake: wake_right(scheduler);
      @ loop invariant clock: clock_modelled(scheduler);
      @ loop invariant bodies: bodies_modelled(scheduler);
      @ loop invariant open: scheduler->stage == KEEL_STAGE_PASS;
      @ loop invariant left: uptime_left(scheduler, scheduler->pass_end - scheduler->cursor + 1);
      @ loop invariant time: \at(scheduler->clock.now_us, Pre) <= scheduler->clock.now_us;
      @ loop invariant busy: scheduler->busy_us <= scheduler->clock.now_us;
      @ loop invariant served: asked_us <= \at(scheduler->clock.now_us, Pre) ==>
      @     \at(served(scheduler), Pre) ==> served(scheduler);
      @ loop assigns status, *scheduler;
      @ loop variant scheduler->pass_end - scheduler->cursor;
      @*/
    do {
        //@ assert ahead: scheduler->cursor <= scheduler->pass_end;
        //@ assert reading: uptime_left(scheduler, 1);
        status = keel_pass_turn(scheduler);
        //@ assert uptime: in_uptime(scheduler);
        /*@ assert left: scheduler->stage == KEEL_STAGE_PASS ==>
          @     uptime_left(scheduler, scheduler->pass_end - scheduler->cursor + 1);
          @*/
    } while (scheduler->stage == KEEL_STAGE_PASS);
    return status;
}

uint32_t keel_pass_idle_us(const keel_scheduler_t *scheduler, uint32_t raw_us, uint32_t latency_us,
                           uint32_t longest_us)
{
    const uint64_t now_us = scheduler->clock.now_us;
    const uint64_t gone_us = (uint64_t)keel_clock_elapsed_us(scheduler->clock.raw_us, raw_us) +
                             latency_us;
    uint64_t ahead_us;

    if ((scheduler->stage != KEEL_STAGE_READY) || (scheduler->wake_us <= now_us)) {
        return 0u;
    }
    ahead_us = scheduler->wake_us - now_us;
    if (ahead_us >= KEEL_CLOCK_STEP_LIMIT_US) {
        ahead_us = KEEL_CLOCK_STEP_LIMIT_US - 1u;
    }
    if (ahead_us <= gone_us) {
        return 0u;
    }
    return ((ahead_us - gone_us) < longest_us) ? (uint32_t)(ahead_us - gone_us) : longest_us;
}
