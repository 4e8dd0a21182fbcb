// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The isolation theorem (requirement ISO-001): with no promotion, and execution times within their
 * budgets, a real-time task starts at most the sum of the other real-time budgets plus the guard W
 * after its release. It holds for any admitted set, and for runs of any length.
 *
 * The function `isolation` is the life of a scheduler: it is started, and then begin, next and
 * finish are called for as long as one likes, each where the scheduler's stage asks for it, as
 * keel_scheduler_step does. They are the kernel's own functions, of which the proof knows their
 * contracts in pass.h and scheduler.h and nothing else. The world is a clock, read at most so long
 * after it was last read:
 *
 *   - W, when a pass begins;
 *   - its budget, when a real-time task has run;
 *   - W and its worst-case time, when another task has run.
 *
 * sum[j] is the sum of the first j real-time budgets, sum[n] that of all. Between passes task j is
 * late by at most sum[n] - sum[j + 1], the budgets of the tasks behind it, because only those have
 * run since the pass looked at it. That, and what becomes of it within a pass, is the invariant of
 * the loop in `isolation`; a function for each stage shows that one call of the kernel keeps it.
 */
#include "keel/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

/*@ // The world: the clock is read, at most limit_us after its last reading (A-14: and soon enough
  @ // to tell the time between the two).
  @ assigns \nothing;
  @ ensures within: clock_elapsed(raw_us, \result) <= limit_us;
  @ ensures known: clock_elapsed(raw_us, \result) < KEEL_CLOCK_STEP_LIMIT_US;
  @*/
uint32_t read_within(uint32_t raw_us, uint64_t limit_us);

/*@ // Who has missed no period goes on by one.
  @ lemma one_period{L}: \forall keel_queue_t *q, integer x, integer now_us;
  @     grid_missed(q, x, now_us) == 0 ==>
  @         grid_next(q, x, now_us) == q->release_us[x] + q->period_us[x];
  @
  @ // sum holds the sums of the real-time budgets, which never fall.
  @ predicate budgets_summed(keel_scheduler_t *s, int64_t *sum) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         sum[j + 1] == sum[j] + s->queue.budget_us[s->queue.order[j]];
  @
  @ predicate sums_rise(int64_t *sum, integer n) =
  @     \forall integer j, k; 0 <= j <= k <= n ==> sum[j] <= sum[k];
  @
  @ // ADM-004: every real-time period holds all real-time budgets and the guard twice.
  @ predicate periods_hold(keel_scheduler_t *s, int64_t *sum) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         sum[s->queue.realtime_count] + 2 * s->config.guard_us
  @             <= s->queue.period_us[s->queue.order[j]];
  @
  @ // How late the tasks from one index to another are: at most limit_us less the budgets up to
  @ // and with their own.
  @ predicate late(keel_scheduler_t *s, int64_t *sum, integer from, integer to,
  @                integer limit_us) =
  @     \forall integer j; from <= j < to ==>
  @         s->clock.now_us - s->queue.release_us[s->queue.order[j]] <= limit_us - sum[j + 1];
  @
  @ // The same of those that the pass has looked at, and of those that it has yet to, when it has
  @ // come to an index.
  @ predicate late_before(keel_scheduler_t *s, int64_t *sum, integer index) =
  @     late(s, sum, 0, s->cursor, sum[index]);
  @
  @ predicate late_behind(keel_scheduler_t *s, int64_t *sum, integer index) =
  @     late(s, sum, s->cursor, s->queue.realtime_count,
  @          s->config.guard_us + sum[index] + sum[s->queue.realtime_count]);
  @
  @ // Every real-time release lies so far ahead that the task at an index ends before it.
  @ predicate room(keel_scheduler_t *s, integer index) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         s->clock.now_us + s->config.guard_us + task_worst(&s->queue, s->queue.order[index])
  @             <= s->queue.release_us[s->queue.order[j]];
  @
  @ // The pass is one over all real-time tasks.
  @ predicate pass_whole(keel_scheduler_t *s) = s->pass_end == s->queue.realtime_count;
  @
  @ // Whether a task that is not real-time has waited so long that it is promoted.
  @ predicate promotion_due(keel_scheduler_t *s) =
  @     \exists integer i; s->queue.realtime_count <= i < s->queue.count &&
  @         due(s, i) && promoted(&s->queue, s->queue.order[i], s->clock.now_us);
  @*/

/* clang-format off: the formatter does not know these clauses. */
/* What every function below asks for ... */
#define SET_GIVEN(s, sum)                                                                          \
    requires memory : \valid(s) && scheduler_valid(s) && in_uptime(s);                             \
    requires wake : wake_right(s);                                                                 \
    requires busy : (s)->busy_us <= (s)->clock.now_us;                                             \
    requires summed : budgets_summed(s, sum);                                                      \
    requires rise : sum[0] == 0 && sums_rise(sum, (s)->queue.realtime_count);                      \
    requires hold : periods_hold(s, sum);

/* ... and keeps. */
#define SET_STAYS(s, sum)                                                                          \
    SCHEDULER_STAYS_VALID(s)                                                                       \
    ensures wake : wake_right(s);                                                                  \
    ensures busy : (s)->busy_us <= (s)->clock.now_us;                                              \
    ensures counts : (s)->queue.realtime_count == \old((s)->queue.realtime_count);                 \
    ensures summed : budgets_summed(s, sum);                                                       \
    ensures hold : periods_hold(s, sum);
/* clang-format on */

/* Adds up the real-time budgets. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ requires room: \valid(sum + (0 .. KEEL_QUEUE_CAPACITY));
  @ assigns sum[0 .. KEEL_QUEUE_CAPACITY];
  @ ensures summed: budgets_summed(s, sum);
  @ ensures rise: sum[0] == 0 && sums_rise(sum, s->queue.realtime_count);
  @ ensures demand: sum[s->queue.realtime_count] ==
  @     realtime_demand(&s->queue, s->queue.count);
  @*/
static void add_up(const keel_scheduler_t *s, int64_t *sum)
{
    const uint32_t n = s->queue.realtime_count;

    sum[0] = 0;
    /*@ loop invariant range: 0 <= j <= n;
      @ loop invariant first: sum[0] == 0;
      @ loop invariant summed: \forall integer i; 0 <= i < j ==>
      @     sum[i + 1] == sum[i] + s->queue.budget_us[s->queue.order[i]];
      @ loop invariant rise: sums_rise(sum, j);
      @ loop invariant bound: sum[j] <= j * UINT32_MAX;
      @ loop invariant demand: sum[j] == realtime_demand(&s->queue, j);
      @ loop assigns j, sum[0 .. KEEL_QUEUE_CAPACITY];
      @ loop variant n - j;
      @*/
    for (uint32_t j = 0u; j < n; j++) {
        sum[j + 1u] = sum[j] + (int64_t)s->queue.budget_us[s->queue.order[j]];
        //@ assert next: realtime_demand(&s->queue, j + 1) == sum[j + 1];
    }
    /*@ loop invariant range: n <= i <= s->queue.count;
      @ loop invariant demand: sum[n] == realtime_demand(&s->queue, i);
      @ loop assigns i;
      @ loop variant s->queue.count - i;
      @*/
    for (uint32_t i = n; i < s->queue.count; i++) {
        //@ assert other: s->queue.priority[s->queue.order[i]] != KEEL_PRIORITY_REALTIME;
        //@ assert next: realtime_demand(&s->queue, i + 1) == realtime_demand(&s->queue, i);
    }
}

/* Starts the scheduler: from then on what is asked for below holds. */
/*@ requires memory: \valid(s) && scheduler_valid(s) && setup_unmoved(s);
  @ requires clock: clock_modelled(s);
  @ requires fresh: s->wake_us == 0 && s->busy_us == 0;
  @ requires summed: budgets_summed(s, sum);
  @ requires rise: sum[0] == 0 && sums_rise(sum, s->queue.realtime_count);
  @ requires demand: sum[s->queue.realtime_count] ==
  @     realtime_demand(&s->queue, s->queue.count);
  @ assigns s->clock.now_us, s->clock.raw_us, s->stage, s->earliest_realtime_us;
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures busy: s->busy_us <= s->clock.now_us;
  @ ensures summed: budgets_summed(s, sum);
  @ ensures hold: \result == KEEL_OK ==> periods_hold(s, sum);
  @ ensures ready: \result == KEEL_OK ==> s->stage == KEEL_STAGE_READY;
  @ ensures late: \result == KEEL_OK ==>
  @     late(s, sum, 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
  @*/
static keel_status_t start(keel_scheduler_t *s, const int64_t *sum)
{
    (void)sum;
    return keel_scheduler_start(s);
}

/* Between passes: a pass begins, or nothing is due. */
/*@ SET_GIVEN(s, sum)
  @ requires ready: s->stage == KEEL_STAGE_READY;
  @ requires late: late(s, sum, 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
  @ assigns s->clock.now_us, s->clock.raw_us, s->wake_us, s->stage, s->cursor, s->pass_end;
  @ SET_STAYS(s, sum)
  @ ensures stage: s->stage == KEEL_STAGE_READY || s->stage == KEEL_STAGE_PASS;
  @ ensures late: s->stage == KEEL_STAGE_READY ==>
  @     late(s, sum, 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
  @ ensures whole: s->stage == KEEL_STAGE_PASS ==> pass_whole(s);
  @ ensures before: s->stage == KEEL_STAGE_PASS ==> late_before(s, sum, s->cursor);
  @ ensures behind: s->stage == KEEL_STAGE_PASS ==> late_behind(s, sum, s->cursor);
  @*/
static void open_pass(keel_scheduler_t *s, const int64_t *sum)
{
    const uint32_t raw_us = read_within(s->clock.raw_us, s->config.guard_us);
    const keel_status_t status = keel_pass_begin(s, raw_us);

    (void)sum;
    (void)status;
    /*@ assert releases: \forall integer k; 0 <= k < s->queue.count ==>
      @     s->queue.release_us[s->queue.order[k]] ==
      @         \at(s->queue.release_us[s->queue.order[k]], Pre);
      @*/
    /*@ assert periods: \forall integer k; 0 <= k < s->queue.count ==>
      @     s->queue.period_us[s->queue.order[k]] ==
      @         \at(s->queue.period_us[s->queue.order[k]], Pre);
      @*/
    /*@ assert budgets: \forall integer k; 0 <= k < s->queue.count ==>
      @     s->queue.budget_us[s->queue.order[k]] ==
      @         \at(s->queue.budget_us[s->queue.order[k]], Pre);
      @*/
    //@ assert time: s->clock.now_us <= \at(s->clock.now_us, Pre) + s->config.guard_us;
    /*@ assert idle: s->stage == KEEL_STAGE_READY ==>
      @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @         s->clock.now_us < s->queue.release_us[s->queue.order[j]];
      @*/
}

/* Whether the next task that is not real-time is served by promotion: as promotion is the highest
 * priority (SCH-016), it is just when one is due to be promoted. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s) && in_uptime(s);
  @ assigns \nothing;
  @ ensures \result <==> promotion_due(s);
  @*/
static bool is_promotion_due(const keel_scheduler_t *s)
{
    const uint64_t now_us = s->clock.now_us;

    /*@ loop invariant range: s->queue.realtime_count <= i <= s->queue.count;
      @ loop invariant none: \forall integer k; s->queue.realtime_count <= k < i ==>
      @     !(due(s, k) && promoted(&s->queue, s->queue.order[k], now_us));
      @ loop assigns i;
      @ loop variant s->queue.count - i;
      @*/
    for (uint32_t i = s->queue.realtime_count; i < s->queue.count; i++) {
        const uint32_t slot = s->queue.order[i];
        const uint64_t release_us = s->queue.release_us[slot];
        const uint32_t period_us = s->queue.period_us[slot];

        if ((release_us <= now_us) &&
            keel_priority_promoted(s->queue.priority[slot], (now_us - release_us) + period_us,
                                   period_us)) {
            return true;
        }
    }
    return false;
}

/* In a pass: a task starts, or the pass ends. */
/*@ SET_GIVEN(s, sum)
  @ requires pass: s->stage == KEEL_STAGE_PASS && pass_whole(s);
  @ requires before: late_before(s, sum, s->cursor);
  @ requires behind: late_behind(s, sum, s->cursor);
  @ assigns s->wake_us, s->stage, s->cursor, s->running, s->earliest_realtime_us,
  @     s->earliest_other_us, s->queue.skipped[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1].promotions;
  @ SET_STAYS(s, sum)
  @ ensures memory: \valid(s);
  @ ensures rise: sum[0] == 0 && sums_rise(sum, s->queue.realtime_count);
  @ ensures stage: s->stage == KEEL_STAGE_READY || stage_running(s);
  @ ensures whole: pass_whole(s);
  @ ensures ready: s->stage == KEEL_STAGE_READY ==>
  @     late(s, sum, 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
  @ ensures realtime: s->stage == KEEL_STAGE_REALTIME ==>
  @     0 <= s->running && s->cursor == s->running + 1 <= s->queue.realtime_count;
  @ ensures bound: s->stage == KEEL_STAGE_REALTIME ==>
  @     s->clock.now_us - \at(s->queue.release_us[s->queue.order[\at(s->running, Post)]], Pre) <=
  @         sum[s->queue.realtime_count] - s->queue.budget_us[s->queue.order[s->running]]
  @         + s->config.guard_us;
  @ ensures before: s->stage == KEEL_STAGE_REALTIME ==> late_before(s, sum, s->running);
  @ ensures behind: s->stage == KEEL_STAGE_REALTIME ==> late_behind(s, sum, s->running);
  @ ensures other: s->stage == KEEL_STAGE_OTHER ==> 0 <= s->running < s->queue.count;
  @ ensures room: s->stage == KEEL_STAGE_OTHER ==> !\old(promotion_due(s)) ==>
  @     room(s, s->running);
  @*/
static void decide(keel_scheduler_t *s, const int64_t *sum)
{
    const keel_task_config_t *const task = keel_pass_next(s);

    (void)sum;
    /*@ assert first: s->stage == KEEL_STAGE_REALTIME ==>
      @     \forall integer j; \at(s->cursor, Pre) <= j < s->running ==>
      @         s->clock.now_us < \at(s->queue.release_us[s->queue.order[j]], Pre);
      @*/
    /*@ assert none: s->stage != KEEL_STAGE_REALTIME ==>
      @     \forall integer j; \at(s->cursor, Pre) <= j < s->queue.realtime_count ==>
      @         s->clock.now_us < \at(s->queue.release_us[s->queue.order[j]], Pre);
      @*/
    /*@ assert releases: task != \null ==>
      @     \forall integer k; 0 <= k < s->queue.count ==> k != s->running ==>
      @         s->queue.release_us[s->queue.order[k]] ==
      @             \at(s->queue.release_us[s->queue.order[k]], Pre);
      @*/
    /*@ assert releases_null: task == \null ==>
      @     \forall integer k; 0 <= k < s->queue.count ==>
      @         s->queue.release_us[s->queue.order[k]] ==
      @             \at(s->queue.release_us[s->queue.order[k]], Pre);
      @*/
    /*@ assert late: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us -
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre) <=
      @         s->config.guard_us + sum[s->running] + sum[s->queue.realtime_count]
      @         - sum[s->running + 1];
      @*/
    /*@ assert none_missed: s->stage == KEEL_STAGE_REALTIME ==>
      @     \at(grid_missed(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us), Pre)
      @     == 0;
      @*/
    /*@ assert next: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->queue.release_us[s->queue.order[s->running]] ==
      @         \at(grid_next(&s->queue, s->queue.order[\at(s->running, Here)],
      @                       s->clock.now_us), Pre);
      @*/
    /*@ assert by_one: s->stage == KEEL_STAGE_REALTIME ==>
      @     \at(grid_next(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us), Pre)
      @     == \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre)
      @         + \at(s->queue.period_us[s->queue.order[\at(s->running, Here)]], Pre);
      @*/
    /*@ assert on_time: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->queue.release_us[s->queue.order[s->running]] ==
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre)
      @         + s->queue.period_us[s->queue.order[s->running]];
      @*/
    /*@ assert fits: s->stage == KEEL_STAGE_OTHER ==> !\at(promotion_due(s), Pre) ==>
      @     \at(fits_slack(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us,
      @                    s->config.guard_us), Pre);
      @*/
}

/* The running task runs for at most so long: time goes on; releases and declarations stay. */
/*@ requires memory: \valid(s) && scheduler_valid(s) && in_uptime(s) && wake_right(s);
  @ requires busy: s->busy_us <= s->clock.now_us;
  @ requires running: stage_running(s) && 0 <= s->running < s->queue.count;
  @ assigns s->clock.now_us, s->clock.raw_us, s->busy_us, s->stage, s->running,
  @     STATS_RUN(s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures busy: s->busy_us <= s->clock.now_us;
  @ ensures stage: s->stage ==
  @     ((\old(s->stage) == KEEL_STAGE_REALTIME) ? KEEL_STAGE_PASS : KEEL_STAGE_READY);
  @ ensures pass: s->cursor == \old(s->cursor) && s->pass_end == \old(s->pass_end);
  @ ensures time: \old(s->clock.now_us) <= s->clock.now_us <= \old(s->clock.now_us) + limit_us;
  @ ensures releases: \forall integer k; 0 <= k < s->queue.count ==>
  @     s->queue.release_us[s->queue.order[k]] == \old(s->queue.release_us[s->queue.order[k]]);
  @ ensures guard: s->config.guard_us == \old(s->config.guard_us);
  @ ensures periods: \forall integer k; 0 <= k < s->queue.count ==>
  @     s->queue.period_us[s->queue.order[k]] == \old(s->queue.period_us[s->queue.order[k]]);
  @ ensures budgets: \forall integer k; 0 <= k < s->queue.count ==>
  @     s->queue.budget_us[s->queue.order[k]] == \old(s->queue.budget_us[s->queue.order[k]]);
  @*/
static void run_at_most(keel_scheduler_t *s, uint64_t limit_us)
{
    const uint32_t raw_us = read_within(s->clock.raw_us, limit_us);
    keel_status_t status;

    status = keel_pass_finish(s, raw_us);
    (void)status;
    /*@ assert release: s->queue.release_us[s->queue.order[\at(s->running, Pre)]] ==
      @     \at(s->queue.release_us[s->queue.order[s->running]], Pre);
      @*/
    /*@ assert releases_others: \forall integer k; 0 <= k < s->queue.count ==>
      @     k != \at(s->running, Pre) ==>
      @     s->queue.release_us[s->queue.order[k]] ==
      @         \at(s->queue.release_us[s->queue.order[k]], Pre);
      @*/
}

/* A real-time task runs: the pass goes on behind it. */
/*@ SET_GIVEN(s, sum)
  @ requires stage: s->stage == KEEL_STAGE_REALTIME && pass_whole(s);
  @ requires running: 0 <= s->running && s->cursor == s->running + 1 <= s->queue.realtime_count;
  @ requires before: late_before(s, sum, s->running);
  @ requires behind: late_behind(s, sum, s->running);
  @ assigns s->clock.now_us, s->clock.raw_us, s->busy_us, s->stage, s->running,
  @     STATS_RUN(s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SET_STAYS(s, sum)
  @ ensures pass: s->stage == KEEL_STAGE_PASS && pass_whole(s);
  @ ensures before: late_before(s, sum, s->cursor);
  @ ensures behind: late_behind(s, sum, s->cursor);
  @*/
static void run_realtime(keel_scheduler_t *s, const int64_t *sum)
{
    (void)sum;
    run_at_most(s, s->queue.budget_us[s->queue.order[s->running]]);
    /*@ assert time: s->clock.now_us + sum[\at(s->running, Pre)] <=
      @     \at(s->clock.now_us, Pre) + sum[s->cursor];
      @*/
}

/* Another task runs: the pass is over before any real-time task is due. */
/*@ SET_GIVEN(s, sum)
  @ requires stage: s->stage == KEEL_STAGE_OTHER && 0 <= s->running < s->queue.count;
  @ requires room: room(s, s->running);
  @ assigns s->clock.now_us, s->clock.raw_us, s->busy_us, s->stage, s->running,
  @     STATS_RUN(s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SET_STAYS(s, sum)
  @ ensures ready: s->stage == KEEL_STAGE_READY;
  @ ensures late: late(s, sum, 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
  @*/
static void run_other(keel_scheduler_t *s, const int64_t *sum)
{
    const uint32_t slot = s->queue.order[s->running];
    const uint32_t remembered_us = s->queue.stats[slot].remembered_us;
    const uint32_t budget_us = s->queue.budget_us[slot];
    const uint64_t worst_us = (remembered_us > budget_us) ? remembered_us : budget_us;

    (void)sum;
    run_at_most(s, s->config.guard_us + worst_us);
    /*@ assert time: s->clock.now_us <= \at(s->clock.now_us
      @     + s->config.guard_us + task_worst(&s->queue, s->queue.order[s->running]), Pre);
      @*/
}

/*@ // As keel_scheduler_init and keel_scheduler_add leave it.
  @ requires memory: \valid(s) && scheduler_valid(s) && setup_unmoved(s);
  @ requires clock: clock_modelled(s);
  @ requires fresh: s->wake_us == 0 && s->busy_us == 0;
  @ assigns *s;
  @*/
void isolation(keel_scheduler_t *s, uint64_t moves)
{
    int64_t sum[KEEL_QUEUE_CAPACITY + 1u];

    add_up(s, sum);
    if (start(s, sum) != KEEL_OK) {
        return;
    }
    /*@ loop invariant memory: \valid(s) && scheduler_valid(s);
      @ loop invariant wake: wake_right(s);
      @ loop invariant busy: s->busy_us <= s->clock.now_us;
      @ loop invariant summed: budgets_summed(s, &sum[0]);
      @ loop invariant rise: sum[0] == 0 && sums_rise(&sum[0], s->queue.realtime_count);
      @ loop invariant hold: periods_hold(s, &sum[0]);
      @ loop invariant stage: KEEL_STAGE_READY <= s->stage <= KEEL_STAGE_OTHER;
      @ loop invariant ready: s->stage == KEEL_STAGE_READY ==>
      @     late(s, &sum[0], 0, s->queue.realtime_count, sum[s->queue.realtime_count]);
      @ loop invariant whole: s->stage == KEEL_STAGE_PASS || s->stage == KEEL_STAGE_REALTIME ==>
      @     pass_whole(s);
      @ loop invariant before: s->stage == KEEL_STAGE_PASS ==>
      @     late_before(s, &sum[0], s->cursor);
      @ loop invariant behind: s->stage == KEEL_STAGE_PASS ==>
      @     late_behind(s, &sum[0], s->cursor);
      @ loop invariant running: s->stage == KEEL_STAGE_REALTIME ==>
      @     0 <= s->running && s->cursor == s->running + 1 <= s->queue.realtime_count;
      @ loop invariant running_before: s->stage == KEEL_STAGE_REALTIME ==>
      @     late_before(s, &sum[0], s->running);
      @ loop invariant running_behind: s->stage == KEEL_STAGE_REALTIME ==>
      @     late_behind(s, &sum[0], s->running);
      @ loop invariant other: s->stage == KEEL_STAGE_OTHER ==>
      @     0 <= s->running < s->queue.count && room(s, s->running);
      @ loop assigns move, *s;
      @ loop variant moves - move;
      @*/
    for (uint64_t move = 0u; move < moves; move++) {
        if (s->clock.now_us > (KEEL_CLOCK_TIME_LIMIT_US - KEEL_CLOCK_STEP_LIMIT_US)) {
            return;
        }
        if (s->stage == KEEL_STAGE_READY) {
            open_pass(s, sum);
        } else if (s->stage == KEEL_STAGE_REALTIME) {
            run_realtime(s, sum);
        } else if (s->stage == KEEL_STAGE_OTHER) {
            run_other(s, sum);
        } else {
            const bool by_promotion = is_promotion_due(s);

            decide(s, sum);
            /*@ assert ISO_001: s->stage == KEEL_STAGE_REALTIME ==>
              @     s->clock.now_us -
              @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]],
              @             LoopCurrent) <=
              @     sum[s->queue.realtime_count] - s->queue.budget_us[s->queue.order[s->running]]
              @         + s->config.guard_us;
              @*/
            if ((s->stage == KEEL_STAGE_OTHER) && by_promotion) {
                return;
            }
        }
    }
}
