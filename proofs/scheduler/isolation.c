// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * The isolation theorems, for any admitted set and runs of any length, while execution times are
 * within their bounds. C sums all real-time budgets, and W is the guard.
 *
 *   - ISO-001: as long as nothing is promoted, and so for ever where the scheduler is configured
 *     without promotion, a real-time task starts at most the sum of the other real-time budgets and
 *     W after its release, and none of its periods is skipped.
 *   - ISO-002: whatever is promoted, it starts at most C, 2 W and L after its release, if no other
 *     task runs longer than L and W. Where its period holds all of that, its own budget does not
 *     count, and none of its periods is skipped.
 *   - ISO-003: before the start keel_scheduler_lateness is asked for each real-time task. No start
 *     is later than what it tells, and no period is skipped where it tells so. Where it tells that
 *     nothing is promoted, nothing is, and ISO-001 holds for ever.
 *
 * The function `isolation` is the life of a scheduler: it is started, and then begin, next and
 * finish are called for as long as one likes, each where the scheduler's stage asks for it, as
 * keel_scheduler_step does; between two passes any task may be removed. They are the kernel's own
 * functions, of which the proof knows their contracts in pass.h and scheduler.h and nothing else.
 * The world is a clock, read at most so long after it was last read:
 *
 *   - W, when a pass begins, or, behind a sleep, what keel_pass_idle_us has allowed for it and the
 *     latency that it was told;
 *   - its budget, when a real-time task has run;
 *   - W and its worst-case time, when another task has run, as long as nothing is promoted;
 *   - W and L, when another task has run and tasks are promoted.
 *
 * sum[j] is the sum of the first j real-time budgets. C is that of all at the start, and stays when
 * tasks leave: sum[n] is C, or less. other_us is what a run of another task adds to the lateness of
 * a real-time one: nothing as long as nothing is promoted, as it has ended before a release comes;
 * else W and L. Once the pass has looked at task j, no release of it has passed: it was not due, or
 * it starts and its release moves on. Between passes it is late by at most what has run since: the
 * budgets behind its own, C - sum[j + 1], and other_us. Its own run counts, too (own), unless its
 * period is so long that its next release is at least as far away as its run is long. That, and
 * what becomes of it within a pass, is the invariant of the loop in `isolation` (stage_kept); a
 * function for each stage shows that one call of the kernel keeps it.
 */
#include "keel/internal/rtos/lateness.h"
#include "keel/internal/rtos/scheduler.h"

#include <stdbool.h>
#include <stdint.h>

/*@ // The world: the clock is read, at most limit_us after its last reading (A-14: and soon enough
  @ // to tell the time between the two).
  @ assigns \nothing;
  @ ensures within: clock_elapsed(raw_us, \result) <= limit_us;
  @ ensures known: clock_elapsed(raw_us, \result) < KEEL_CLOCK_STEP_LIMIT_US;
  @*/
uint32_t read_within(uint32_t raw_us, uint64_t limit_us);

/*@ // The loop: whether it asks how long it may sleep before a step, with which numbers, and which
  @ // task leaves.
  @ assigns \nothing;
  @*/
uint32_t any_number(void);

/** What the bounds are made of. The kernel has no numbers of that type, so it writes none. */
typedef struct {
    int64_t sum[KEEL_QUEUE_CAPACITY + 1u]; /**< The sums of the first real-time budgets. */
    int64_t own[KEEL_QUEUE_CAPACITY];      /**< By slot: what its own run may add to it. */
    int64_t all_us;                        /**< The sum of all of them at the start. */
    int64_t other_us; /**< What another task's run may add to the lateness of any. */
    int64_t bound_us[KEEL_QUEUE_CAPACITY]; /**< By slot: how late it starts at the latest. */
    int64_t steady[KEEL_QUEUE_CAPACITY];   /**< By slot: 1 if none of its periods is skipped. */
} account_t;

/*@ // Who has missed no period goes on by one.
  @ lemma one_period{L}: \forall keel_queue_t *q, integer x, integer now_us;
  @     grid_missed(q, x, now_us) == 0 ==>
  @         grid_next(q, x, now_us) == q->release_us[x] + q->period_us[x];
  @
  @ // sum holds the sums of the real-time budgets, which never fall.
  @ predicate budgets_summed(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         a->sum[j + 1] == a->sum[j] + s->queue.budget_us[s->queue.order[j]];
  @
  @ predicate sums_rise(account_t *a, integer n) =
  @     \forall integer j, k; 0 <= j <= k <= n ==> a->sum[j] <= a->sum[k];
  @
  @ // All that can pass between two looks at a task.
  @ logic integer turn(keel_scheduler_t *s, account_t *a) =
  @     a->all_us + s->config.guard_us + a->other_us;
  @
  @ predicate own_counted(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         a->own[s->queue.order[j]] ==
  @             ((turn(s, a) <= s->queue.period_us[s->queue.order[j]])
  @                  ? 0 : s->queue.budget_us[s->queue.order[j]]);
  @
  @ predicate own_least(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==> 0 <= a->own[s->queue.order[j]];
  @
  @ predicate none_counted(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==> a->own[s->queue.order[j]] == 0;
  @
  @ // The bounds, whoever told them.
  @ predicate bounded(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         a->bound_us[s->queue.order[j]] ==
  @             turn(s, a) - s->queue.budget_us[s->queue.order[j]] + a->own[s->queue.order[j]];
  @
  @ predicate steadied(keel_scheduler_t *s, account_t *a) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         a->steady[s->queue.order[j]] != 0 ==> a->own[s->queue.order[j]] == 0;
  @
  @ predicate still_never{L, M}(keel_scheduler_t *s) =
  @     \at(never_promotes(s), L) ==> \at(never_promotes(s), M);
  @
  @ predicate all_counted(keel_scheduler_t *s, account_t *a) =
  @     a->sum[s->queue.realtime_count] <= a->all_us;
  @
  @ // How late the tasks from one index to another are: at most limit_us less the budgets up to
  @ // and with their own, which counts where the period is too short.
  @ predicate late(keel_scheduler_t *s, account_t *a, integer from, integer to,
  @                integer limit_us) =
  @     \forall integer j; from <= j < to ==>
  @         s->clock.now_us - s->queue.release_us[s->queue.order[j]] <=
  @             limit_us - a->sum[j + 1] + a->own[s->queue.order[j]];
  @
  @ // The pass is one over all real-time tasks.
  @ predicate pass_whole(keel_scheduler_t *s) = s->pass_end == s->queue.realtime_count;
  @
  @ // Between passes ...
  @ predicate late_between(keel_scheduler_t *s, account_t *a) =
  @     late(s, a, 0, s->queue.realtime_count, a->all_us + a->other_us);
  @
  @ // ... and within one, of those that the pass has looked at, and of those that it has yet to,
  @ // so long before the budgets of all that it has looked at are used up.
  @ predicate late_before(keel_scheduler_t *s, account_t *a, integer left_us) =
  @     late(s, a, 0, s->cursor, a->sum[s->cursor] - left_us);
  @
  @ predicate late_behind(keel_scheduler_t *s, account_t *a, integer left_us) =
  @     late(s, a, s->cursor, s->queue.realtime_count, s->config.guard_us + a->other_us
  @          + a->all_us + a->sum[s->cursor] - left_us);
  @
  @ // When another task runs, the pass has looked at all of them.
  @ predicate late_all(keel_scheduler_t *s, account_t *a) =
  @     late(s, a, 0, s->queue.realtime_count, a->sum[s->queue.realtime_count]);
  @
  @ // Its run adds no more than what is allowed for, or ends before every real-time release.
  @ predicate held(keel_scheduler_t *s, account_t *a, integer run_us) =
  @     run_us <= a->other_us || \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         s->clock.now_us + run_us <= s->queue.release_us[s->queue.order[j]];
  @
  @ // What holds at each stage; the task that runs takes at most run_us.
  @ predicate stage_kept(keel_scheduler_t *s, account_t *a, integer run_us) =
  @     KEEL_STAGE_READY <= s->stage <= KEEL_STAGE_OTHER &&
  @     (s->stage == KEEL_STAGE_READY ==> late_between(s, a)) &&
  @     (s->stage == KEEL_STAGE_PASS ==> pass_whole(s)) &&
  @     (s->stage == KEEL_STAGE_PASS ==> late_before(s, a, 0)) &&
  @     (s->stage == KEEL_STAGE_PASS ==> late_behind(s, a, 0)) &&
  @     (s->stage == KEEL_STAGE_REALTIME ==> pass_whole(s)) &&
  @     (s->stage == KEEL_STAGE_REALTIME ==> late_before(s, a, run_us)) &&
  @     (s->stage == KEEL_STAGE_REALTIME ==> late_behind(s, a, run_us)) &&
  @     (s->stage == KEEL_STAGE_OTHER ==> late_all(s, a)) &&
  @     (s->stage == KEEL_STAGE_OTHER ==> held(s, a, run_us));
  @
  @ // Every real-time release lies so far ahead that the task at an index ends before it.
  @ predicate room(keel_scheduler_t *s, integer index) =
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         s->clock.now_us + s->config.guard_us + task_worst(&s->queue, s->queue.order[index])
  @             <= s->queue.release_us[s->queue.order[j]];
  @
  @ // Whether a task that is not real-time has waited so long that it is promoted.
  @ predicate promotion_due(keel_scheduler_t *s) = s->config.without_promotion == 0 &&
  @     \exists integer i; s->queue.realtime_count <= i < s->queue.count &&
  @         due(s, i) && promoted(&s->queue, s->queue.order[i], s->clock.now_us);
  @*/

/* clang-format off: the formatter does not know these clauses. */
/* What every function below asks for ... */
#define SET_GIVEN(s, a)                                                                            \
    requires memory : \valid(s) && scheduler_valid(s) && in_uptime(s);                             \
    requires wake : wake_right(s);                                                                 \
    requires busy : (s)->busy_us <= (s)->clock.now_us;                                             \
    requires summed : budgets_summed(s, a);                                                        \
    requires rise : (a)->sum[0] == 0 && sums_rise(a, (s)->queue.realtime_count);                   \
    requires own : own_counted(s, a);                                                              \
    requires least : own_least(s, a);                                                              \
    requires all : all_counted(s, a);                                                              \
    requires bounded : bounded(s, a);                                                              \
    requires steady : steadied(s, a);                                                              \
    requires more : 0 <= (a)->other_us;

/* ... and keeps. */
#define SET_STAYS(s, a)                                                                            \
    SCHEDULER_STAYS_VALID(s)                                                                       \
    ensures wake : wake_right(s);                                                                  \
    ensures busy : (s)->busy_us <= (s)->clock.now_us;                                              \
    ensures counts : (s)->queue.realtime_count == \old((s)->queue.realtime_count);                 \
    ensures guard : (s)->config.guard_us == \old((s)->config.guard_us);                            \
    ensures summed : budgets_summed(s, a);                                                         \
    ensures own : own_counted(s, a);                                                               \
    ensures least : own_least(s, a);                                                               \
    ensures all : all_counted(s, a);                                                               \
    ensures bounded : bounded(s, a);                                                               \
    ensures steady : steadied(s, a);                                                               \
    ensures never : still_never{Pre, Post}(s);
/* clang-format on */

/* Adds up the real-time budgets. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ requires room: \valid(a);
  @ assigns a->sum[0 .. KEEL_QUEUE_CAPACITY];
  @ ensures summed: budgets_summed(s, a);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ ensures bound: a->sum[s->queue.realtime_count] <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
  @ ensures demand: a->sum[s->queue.realtime_count] ==
  @     realtime_demand(&s->queue, s->queue.count);
  @*/
static void add_up(const keel_scheduler_t *s, account_t *a)
{
    const uint32_t n = s->queue.realtime_count;

    a->sum[0] = 0;
    /*@ loop invariant range: 0 <= j <= n;
      @ loop invariant first: a->sum[0] == 0;
      @ loop invariant summed: \forall integer i; 0 <= i < j ==>
      @     a->sum[i + 1] == a->sum[i] + s->queue.budget_us[s->queue.order[i]];
      @ loop invariant rise: sums_rise(a, j);
      @ loop invariant bound: a->sum[j] <= j * UINT32_MAX;
      @ loop invariant demand: a->sum[j] == realtime_demand(&s->queue, j);
      @ loop assigns j, a->sum[0 .. KEEL_QUEUE_CAPACITY];
      @ loop variant n - j;
      @*/
    for (uint32_t j = 0u; j < n; j++) {
        a->sum[j + 1u] = a->sum[j] + (int64_t)s->queue.budget_us[s->queue.order[j]];
        //@ assert next: realtime_demand(&s->queue, j + 1) == a->sum[j + 1];
    }
    /*@ loop invariant range: n <= i <= s->queue.count;
      @ loop invariant demand: a->sum[n] == realtime_demand(&s->queue, i);
      @ loop assigns i;
      @ loop variant s->queue.count - i;
      @*/
    for (uint32_t i = n; i < s->queue.count; i++) {
        //@ assert other: s->queue.priority[s->queue.order[i]] != KEEL_PRIORITY_REALTIME;
        //@ assert next: realtime_demand(&s->queue, i + 1) == realtime_demand(&s->queue, i);
    }
}

/* Says for each real-time task whether its own run counts. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ requires room: \valid(a);
  @ requires range: 0 <= a->all_us <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
  @ requires more: 0 <= a->other_us <= 2 * UINT32_MAX;
  @ assigns a->own[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures own: own_counted(s, a);
  @ ensures least: own_least(s, a);
  @*/
static void count_own(const keel_scheduler_t *s, account_t *a)
{
    const uint32_t n = s->queue.realtime_count;
    const int64_t turn_us = a->all_us + (int64_t)s->config.guard_us + a->other_us;

    /*@ loop invariant range: 0 <= j <= n;
      @ loop invariant own: \forall integer i; 0 <= i < j ==>
      @     a->own[s->queue.order[i]] == ((turn_us <= s->queue.period_us[s->queue.order[i]])
      @                                       ? 0 : s->queue.budget_us[s->queue.order[i]]);
      @ loop assigns j, a->own[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant n - j;
      @*/
    for (uint32_t j = 0u; j < n; j++) {
        const uint32_t slot = s->queue.order[j];
        const bool holds = turn_us <= (int64_t)s->queue.period_us[slot];

        a->own[slot] = holds ? 0 : (int64_t)s->queue.budget_us[slot];
    }
}

/* The longest budget of a task that is not real-time. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ assigns \nothing;
  @ ensures longest: \result == longest_other(&s->queue, s->queue.count);
  @*/
static uint32_t longest_budget(const keel_scheduler_t *s)
{
    uint32_t longest_us = 0u;

    /*@ loop invariant range: 0 <= i <= s->queue.count;
      @ loop invariant longest: longest_us == longest_other(&s->queue, i);
      @ loop assigns i, longest_us;
      @ loop variant s->queue.count - i;
      @*/
    for (uint32_t i = 0u; i < s->queue.count; i++) {
        const uint32_t slot = s->queue.order[i];

        if ((i >= s->queue.realtime_count) && (longest_us < s->queue.budget_us[slot])) {
            longest_us = s->queue.budget_us[slot];
        }
        //@ assert next: longest_other(&s->queue, i + 1) == longest_us;
    }
    return longest_us;
}

/* Whether any task may ever be promoted. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ assigns \nothing;
  @ ensures promotes: \result == 0 <==> never_promotes(s);
  @*/
static bool may_promote(const keel_scheduler_t *s)
{
    return (!s->config.without_promotion) && (s->queue.realtime_count != s->queue.count);
}

/* clang-format off: the formatter does not know these clauses. */
#define ASKED_ABOUT(s, a)                                                                          \
    requires memory : \valid_read(s) && scheduler_valid(s);                                        \
    requires room : \valid(a);                                                                     \
    requires range : 0 <= (a)->all_us <= KEEL_QUEUE_CAPACITY *UINT32_MAX;                          \
    requires demand : (a)->all_us == realtime_demand(&(s)->queue, (s)->queue.count);               \
    requires own : own_counted(s, a);                                                              \
    requires other : (a)->other_us == (promoting ? (s)->config.guard_us + longest_us : 0);
/* clang-format on */

/* How late the real-time task at a position starts at the latest. The kernel tells it: as long as
 * nothing is promoted, in every case; else where tasks may be promoted, and L is the longest other
 * budget. For other L it is calculated. */
/*@ ASKED_ABOUT(s, a)
  @ requires position: j < s->queue.realtime_count;
  @ assigns a->bound_us[s->queue.order[j]], a->steady[s->queue.order[j]];
  @ ensures bounded: \result == KEEL_OK ==> a->bound_us[s->queue.order[j]] ==
  @     turn(s, a) - s->queue.budget_us[s->queue.order[j]] + a->own[s->queue.order[j]];
  @ ensures steady: \result == KEEL_OK ==>
  @     a->steady[s->queue.order[j]] != 0 ==> a->own[s->queue.order[j]] == 0;
  @ ensures refused: \result != KEEL_OK ==> !scheduler_holds(s);
  @*/
static keel_status_t ask(const keel_scheduler_t *s, account_t *a, bool promoting,
                         uint32_t longest_us, uint32_t j)
{
    const uint32_t slot = s->queue.order[j];
    const int64_t own_us = a->own[slot];
    const int64_t bound_us = (a->all_us + (int64_t)s->config.guard_us + a->other_us + own_us) -
                             (int64_t)s->queue.budget_us[slot];
    const bool told = promoting && may_promote(s) && (longest_us == longest_budget(s));
    keel_lateness_t lateness;
    keel_status_t status;

    //@ assert at: is_at(s, j, s->queue.task[slot]);
    //@ assert realtime: is_realtime(s, s->queue.task[slot]);
    status = keel_scheduler_lateness(s, s->queue.task[slot], &lateness);
    if (status != KEEL_OK) {
        return status;
    }
    //@ assert ISO_003_promotes: lateness.promotes == 0 <==> never_promotes(s);
    //@ assert ISO_003_same: lateness.promotes == 0 ==> lateness.late_us == lateness.unpromoted_us;
    //@ assert ISO_003_unpromoted: !promoting ==> lateness.unpromoted_us == bound_us;
    //@ assert ISO_003_late: told ==> lateness.late_us == bound_us;
    //@ assert ISO_003_skips: told ==> lateness.skips == 0 ==> own_us == 0;
    if (told) {
        a->bound_us[slot] = (int64_t)lateness.late_us;
        a->steady[slot] = lateness.skips ? 0 : 1;
    } else {
        a->bound_us[slot] = promoting ? bound_us : (int64_t)lateness.unpromoted_us;
        a->steady[slot] = (own_us == 0) ? 1 : 0;
    }
    return KEEL_OK;
}

/* The same of each of them. */
/*@ ASKED_ABOUT(s, a)
  @ assigns a->bound_us[0 .. KEEL_QUEUE_CAPACITY - 1], a->steady[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ ensures own: \result == KEEL_OK ==> own_counted(s, a);
  @ ensures bounded: \result == KEEL_OK ==> bounded(s, a);
  @ ensures steady: \result == KEEL_OK ==> steadied(s, a);
  @ ensures refused: \result != KEEL_OK ==> !scheduler_holds(s);
  @*/
static keel_status_t ask_all(const keel_scheduler_t *s, account_t *a, bool promoting,
                             uint32_t longest_us)
{
    const uint32_t n = s->queue.realtime_count;

    /*@ loop invariant range: 0 <= j <= n;
      @ loop invariant own: own_counted(s, a);
      @ loop invariant bounded: \forall integer i; 0 <= i < j ==>
      @     a->bound_us[s->queue.order[i]] ==
      @         turn(s, a) - s->queue.budget_us[s->queue.order[i]] + a->own[s->queue.order[i]];
      @ loop invariant steady: \forall integer i; 0 <= i < j ==>
      @     a->steady[s->queue.order[i]] != 0 ==> a->own[s->queue.order[i]] == 0;
      @ loop assigns j, a->bound_us[0 .. KEEL_QUEUE_CAPACITY - 1],
      @     a->steady[0 .. KEEL_QUEUE_CAPACITY - 1];
      @ loop variant n - j;
      @*/
    for (uint32_t j = 0u; j < n; j++) {
        const keel_status_t status = ask(s, a, promoting, longest_us, j);

        if (status != KEEL_OK) {
            return status;
        }
    }
    return KEEL_OK;
}

/* All that the bounds are made of. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ requires room: \valid(a);
  @ assigns *a;
  @ ensures summed: budgets_summed(s, a);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ ensures own: \result == KEEL_OK ==> own_counted(s, a);
  @ ensures least: own_least(s, a);
  @ ensures all: a->all_us == a->sum[s->queue.realtime_count];
  @ ensures demand: a->all_us == realtime_demand(&s->queue, s->queue.count);
  @ ensures other: a->other_us == (promoting ? s->config.guard_us + longest_us : 0);
  @ ensures bounded: \result == KEEL_OK ==> bounded(s, a);
  @ ensures steady: \result == KEEL_OK ==> steadied(s, a);
  @ ensures refused: \result != KEEL_OK ==> !scheduler_holds(s);
  @*/
static keel_status_t prepare(const keel_scheduler_t *s, account_t *a, bool promoting,
                             uint32_t longest_us)
{
    a->other_us = promoting ? ((int64_t)s->config.guard_us + (int64_t)longest_us) : 0;
    add_up(s, a);
    a->all_us = a->sum[s->queue.realtime_count];
    count_own(s, a);
    return ask_all(s, a, promoting, longest_us);
}

/* Starts the scheduler: from then on what is asked for below holds. */
/*@ requires memory: \valid(s) && scheduler_valid(s) && setup_unmoved(s);
  @ requires clock: clock_modelled(s);
  @ requires fresh: s->wake_us == 0 && s->busy_us == 0;
  @ requires summed: budgets_summed(s, a);
  @ requires rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ requires own: own_counted(s, a);
  @ requires least: own_least(s, a);
  @ requires all: all_counted(s, a);
  @ requires bounded: bounded(s, a);
  @ requires steady: steadied(s, a);
  @ requires more: 0 <= a->other_us;
  @ requires demand: a->sum[s->queue.realtime_count] ==
  @     realtime_demand(&s->queue, s->queue.count);
  @ assigns s->clock.now_us, s->clock.raw_us, s->stage, s->earliest_realtime_us;
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures busy: s->busy_us <= s->clock.now_us;
  @ ensures summed: budgets_summed(s, a);
  @ ensures own: own_counted(s, a);
  @ ensures bounded: bounded(s, a);
  @ ensures steady: steadied(s, a);
  @ ensures never: still_never{Pre, Post}(s);
  @ ensures guard: s->config.guard_us == \old(s->config.guard_us);
  @ ensures hold: \result == KEEL_OK ==>
  @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
  @         a->sum[s->queue.realtime_count] + 2 * s->config.guard_us
  @             <= s->queue.period_us[s->queue.order[j]];
  @ ensures ready: \result == KEEL_OK ==> s->stage == KEEL_STAGE_READY;
  @ ensures late: \result == KEEL_OK ==> late_between(s, a);
  @ ensures none: \result == KEEL_OK ==> a->other_us == 0 ==>
  @     a->all_us == a->sum[s->queue.realtime_count] ==> none_counted(s, a);
  @*/
static keel_status_t start(keel_scheduler_t *s, const account_t *a)
{
    const keel_status_t status = keel_scheduler_start(s);

    (void)a;
    /*@ assert periods: \forall integer k; 0 <= k < s->queue.count ==>
      @     s->queue.period_us[s->queue.order[k]] ==
      @         \at(s->queue.period_us[s->queue.order[k]], Pre);
      @*/
    /*@ assert budgets: \forall integer k; 0 <= k < s->queue.count ==>
      @     s->queue.budget_us[s->queue.order[k]] ==
      @         \at(s->queue.budget_us[s->queue.order[k]], Pre);
      @*/
    //@ assert turn: turn(s, a) == \at(turn(s, a), Pre);
    /*@ assert early: status == KEEL_OK ==> \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->clock.now_us <= s->queue.release_us[s->queue.order[j]];
      @*/
    return status;
}

/* Between passes: the clock's reading for the next step, behind a sleep or not. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s) && in_uptime(s);
  @ requires ready: s->stage == KEEL_STAGE_READY;
  @ assigns \nothing;
  @ ensures known: clock_elapsed(s->clock.raw_us, \result) < KEEL_CLOCK_STEP_LIMIT_US;
  @ ensures soon: clock_elapsed(s->clock.raw_us, \result) <= s->config.guard_us ||
  @     (s->clock.now_us < s->wake_us &&
  @      s->clock.now_us + clock_elapsed(s->clock.raw_us, \result) <= s->wake_us);
  @*/
static uint32_t read_for_step(const keel_scheduler_t *s)
{
    const uint32_t latency_us = any_number();
    const uint32_t asked_at = read_within(s->clock.raw_us, KEEL_CLOCK_STEP_LIMIT_US);
    const uint32_t idle_us = keel_pass_idle_us(s, asked_at, latency_us, any_number());
    uint32_t raw_us;

    if (idle_us == 0u) {
        return read_within(s->clock.raw_us, s->config.guard_us);
    }
    raw_us = read_within(asked_at, (uint64_t)idle_us + latency_us);
    /*@ assert slept: clock_elapsed(s->clock.raw_us, raw_us) ==
      @     clock_elapsed(s->clock.raw_us, asked_at) + clock_elapsed(asked_at, raw_us);
      @*/
    return raw_us;
}

/* Between passes: a pass begins, or nothing is due. */
/*@ SET_GIVEN(s, a)
  @ requires ready: s->stage == KEEL_STAGE_READY;
  @ requires late: late_between(s, a);
  @ assigns s->clock.now_us, s->clock.raw_us, s->wake_us, s->stage, s->cursor, s->pass_end;
  @ SET_STAYS(s, a)
  @ ensures kept: stage_kept(s, a, 0);
  @*/
static void open_pass(keel_scheduler_t *s, const account_t *a)
{
    const uint32_t raw_us = read_for_step(s);
    const keel_status_t status = keel_pass_begin(s, raw_us);

    (void)a;
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
    /*@ assert time: s->clock.now_us <= \at(s->clock.now_us, Pre) + s->config.guard_us ||
      @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @         s->clock.now_us <= s->queue.release_us[s->queue.order[j]];
      @*/
    /*@ assert idle: s->stage == KEEL_STAGE_READY ==>
      @     \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @         s->clock.now_us < s->queue.release_us[s->queue.order[j]];
      @*/
    //@ assert stage: s->stage == KEEL_STAGE_READY || s->stage == KEEL_STAGE_PASS;
    //@ assert late: s->stage == KEEL_STAGE_READY ==> late_between(s, a);
    //@ assert before: s->stage == KEEL_STAGE_PASS ==> late_before(s, a, 0);
    //@ assert behind: s->stage == KEEL_STAGE_PASS ==> late_behind(s, a, 0);
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

    if (s->config.without_promotion) {
        return false;
    }
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
/*@ SET_GIVEN(s, a)
  @ requires pass: s->stage == KEEL_STAGE_PASS && pass_whole(s);
  @ requires before: late_before(s, a, 0);
  @ requires behind: late_behind(s, a, 0);
  @ assigns s->wake_us, s->stage, s->cursor, s->running, s->earliest_realtime_us,
  @     s->earliest_other_us, s->queue.skipped[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1].promotions;
  @ SET_STAYS(s, a)
  @ ensures memory: \valid(s);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ ensures stage: s->stage == KEEL_STAGE_READY || stage_running(s);
  @ ensures whole: pass_whole(s);
  @ ensures ready: s->stage == KEEL_STAGE_READY ==> late_between(s, a);
  @ ensures realtime: s->stage == KEEL_STAGE_REALTIME ==>
  @     0 <= s->running && s->cursor == s->running + 1 <= s->queue.realtime_count;
  @ ensures bound: s->stage == KEEL_STAGE_REALTIME ==>
  @     s->clock.now_us - \at(s->queue.release_us[s->queue.order[\at(s->running, Post)]], Pre) <=
  @         a->all_us - s->queue.budget_us[s->queue.order[s->running]]
  @         + s->config.guard_us + a->other_us + a->own[s->queue.order[s->running]];
  @ ensures unskipped: s->stage == KEEL_STAGE_REALTIME ==>
  @     a->own[s->queue.order[s->running]] == 0 ==>
  @     s->queue.skipped[s->queue.order[s->running]] ==
  @         \at(s->queue.skipped[s->queue.order[\at(s->running, Post)]], Pre);
  @ ensures before: s->stage == KEEL_STAGE_REALTIME ==>
  @     late_before(s, a, s->queue.budget_us[s->queue.order[s->running]]);
  @ ensures behind: s->stage == KEEL_STAGE_REALTIME ==>
  @     late_behind(s, a, s->queue.budget_us[s->queue.order[s->running]]);
  @ ensures other: s->stage == KEEL_STAGE_OTHER ==> 0 <= s->running < s->queue.count;
  @ ensures all_late: s->stage == KEEL_STAGE_OTHER ==> late_all(s, a);
  @ ensures room: s->stage == KEEL_STAGE_OTHER ==> !\old(promotion_due(s)) ==>
  @     room(s, s->running);
  @*/
static void decide(keel_scheduler_t *s, const account_t *a)
{
    const keel_task_config_t *const task = keel_pass_next(s);

    (void)a;
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
      @         s->config.guard_us + a->other_us + a->all_us + a->sum[s->running]
      @         - a->sum[s->running + 1] + a->own[s->queue.order[s->running]];
      @*/
    /*@ assert none_missed: s->stage == KEEL_STAGE_REALTIME ==>
      @     a->own[s->queue.order[s->running]] == 0 ==>
      @     \at(grid_missed(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us), Pre)
      @     == 0;
      @*/
    /*@ assert next: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->queue.release_us[s->queue.order[s->running]] ==
      @         \at(grid_next(&s->queue, s->queue.order[\at(s->running, Here)],
      @                       s->clock.now_us), Pre);
      @*/
    /*@ assert by_one: s->stage == KEEL_STAGE_REALTIME ==>
      @     a->own[s->queue.order[s->running]] == 0 ==>
      @     \at(grid_next(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us), Pre)
      @     == \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre)
      @         + \at(s->queue.period_us[s->queue.order[\at(s->running, Here)]], Pre);
      @*/
    /*@ assert on_time: s->stage == KEEL_STAGE_REALTIME ==>
      @     a->own[s->queue.order[s->running]] == 0 ==>
      @     s->queue.release_us[s->queue.order[s->running]] ==
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre)
      @         + s->queue.period_us[s->queue.order[s->running]];
      @*/
    /*@ assert ahead: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us < s->queue.release_us[s->queue.order[s->running]];
      @*/
    /*@ assert counted: s->stage == KEEL_STAGE_REALTIME ==>
      @     (a->own[s->queue.order[s->running]] == 0 &&
      @      turn(s, a) <= s->queue.period_us[s->queue.order[s->running]]) ||
      @     a->own[s->queue.order[s->running]] == a->sum[s->running + 1] - a->sum[s->running];
      @*/
    /*@ assert served: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us - s->queue.release_us[s->queue.order[s->running]] <=
      @         a->sum[s->running] - a->sum[s->running + 1] + a->own[s->queue.order[s->running]];
      @*/
    /*@ assert passed: s->stage == KEEL_STAGE_REALTIME ==>
      @     \forall integer j; \at(s->cursor, Pre) <= j < s->running ==>
      @         s->clock.now_us - s->queue.release_us[s->queue.order[j]] <=
      @             a->sum[s->running] - a->sum[j + 1] + a->own[s->queue.order[j]];
      @*/
    /*@ assert looked: \forall integer j; 0 <= j < \at(s->cursor, Pre) ==>
      @     s->clock.now_us - s->queue.release_us[s->queue.order[j]] <=
      @         a->sum[\at(s->cursor, Pre)] - a->sum[j + 1] + a->own[s->queue.order[j]];
      @*/
    /*@ assert further: a->sum[\at(s->cursor, Pre)] <=
      @     ((s->stage == KEEL_STAGE_REALTIME) ? a->sum[s->running]
      @                                        : a->sum[s->queue.realtime_count]);
      @*/
    /*@ assert budget: s->stage == KEEL_STAGE_REALTIME ==>
      @     a->sum[s->cursor] - s->queue.budget_us[s->queue.order[s->running]] ==
      @         a->sum[s->running];
      @*/
    /*@ assert unserved: s->stage != KEEL_STAGE_REALTIME ==>
      @     \forall integer j; \at(s->cursor, Pre) <= j < s->queue.realtime_count ==>
      @         s->clock.now_us - s->queue.release_us[s->queue.order[j]] <=
      @             a->sum[s->queue.realtime_count] - a->sum[j + 1] + a->own[s->queue.order[j]];
      @*/
    /*@ assert fits: s->stage == KEEL_STAGE_OTHER ==> !\at(promotion_due(s), Pre) ==>
      @     \at(fits_slack(&s->queue, s->queue.order[\at(s->running, Here)], s->clock.now_us,
      @                    s->config.guard_us), Pre);
      @*/
}

/* The running task runs for at most so long: time goes on; releases and declarations stay. */
/*@ requires memory: \valid(s) && scheduler_valid(s) && in_uptime(s) && wake_right(s);
  @ requires busy: s->busy_us <= s->clock.now_us;
  @ requires running: stage_running(s);
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
}

/* A real-time task runs: the pass goes on behind it. */
/*@ SET_GIVEN(s, a)
  @ requires stage: s->stage == KEEL_STAGE_REALTIME && pass_whole(s);
  @ requires before: late_before(s, a, run_us);
  @ requires behind: late_behind(s, a, run_us);
  @ assigns s->clock.now_us, s->clock.raw_us, s->busy_us, s->stage, s->running,
  @     STATS_RUN(s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SET_STAYS(s, a)
  @ ensures kept: stage_kept(s, a, 0);
  @*/
static void run_realtime(keel_scheduler_t *s, const account_t *a, uint64_t run_us)
{
    (void)a;
    run_at_most(s, run_us);
    /*@ assert releases: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->queue.release_us[s->queue.order[j]] ==
      @         \at(s->queue.release_us[s->queue.order[j]], Pre);
      @*/
    //@ assert time: s->clock.now_us <= \at(s->clock.now_us, Pre) + run_us;
    //@ assert cursor: s->cursor == \at(s->cursor, Pre);
    //@ assert before: late_before(s, a, 0);
    //@ assert behind: late_behind(s, a, 0);
}

/* Another task runs: the pass is over. */
/*@ SET_GIVEN(s, a)
  @ requires stage: s->stage == KEEL_STAGE_OTHER;
  @ requires all_late: late_all(s, a);
  @ requires held: held(s, a, run_us);
  @ assigns s->clock.now_us, s->clock.raw_us, s->busy_us, s->stage, s->running,
  @     STATS_RUN(s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1]);
  @ SET_STAYS(s, a)
  @ ensures kept: stage_kept(s, a, 0);
  @*/
static void run_other(keel_scheduler_t *s, const account_t *a, uint64_t run_us)
{
    (void)a;
    run_at_most(s, run_us);
    /*@ assert releases: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->queue.release_us[s->queue.order[j]] ==
      @         \at(s->queue.release_us[s->queue.order[j]], Pre);
      @*/
    //@ assert time: s->clock.now_us <= \at(s->clock.now_us, Pre) + run_us;
    //@ assert late: late_between(s, a);
}

/* How long the task may run that was just handed out. */
/*@ requires memory: \valid_read(s) && scheduler_valid(s);
  @ requires running: stage_running(s) && 0 <= s->running < s->queue.count;
  @ assigns \nothing;
  @ ensures realtime: s->stage == KEEL_STAGE_REALTIME ==>
  @     \result == s->queue.budget_us[s->queue.order[s->running]];
  @ ensures other: s->stage == KEEL_STAGE_OTHER ==> \result == s->config.guard_us +
  @     (promoting ? longest_us : task_worst(&s->queue, s->queue.order[s->running]));
  @*/
static uint64_t longest_run(const keel_scheduler_t *s, bool promoting, uint32_t longest_us)
{
    const uint32_t slot = s->queue.order[s->running];
    const uint32_t budget_us = s->queue.budget_us[slot];
    uint32_t worst_us = s->queue.stats[slot].remembered_us;

    if (s->stage == KEEL_STAGE_REALTIME) {
        return budget_us;
    }
    if (promoting) {
        return s->config.guard_us + (uint64_t)longest_us;
    }
    if (worst_us < budget_us) {
        worst_us = budget_us;
    }
    return s->config.guard_us + (uint64_t)worst_us;
}

/* In a pass: a task starts, for which the theorems say how late, or the pass ends. Returns how long
 * the task may run. */
/*@ SET_GIVEN(s, a)
  @ requires pass: s->stage == KEEL_STAGE_PASS;
  @ requires kept: stage_kept(s, a, 0);
  @ requires other: a->other_us == (promoting ? s->config.guard_us + longest_us : 0);
  @ requires none: !promoting ==> none_counted(s, a);
  @ assigns s->wake_us, s->stage, s->cursor, s->running, s->earliest_realtime_us,
  @     s->earliest_other_us, s->queue.skipped[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.release_us[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.stats[0 .. KEEL_QUEUE_CAPACITY - 1].promotions;
  @ SET_STAYS(s, a)
  @ ensures kept: promoting || !\old(promotion_due(s)) || s->stage != KEEL_STAGE_OTHER ==>
  @     stage_kept(s, a, \result);
  @*/
static uint64_t serve(keel_scheduler_t *s, const account_t *a, bool promoting, uint32_t longest_us)
{
    uint64_t run_us = 0u;

    decide(s, a);
    //@ assert realtime: !promoting ==> turn(s, a) == a->all_us + s->config.guard_us;
    /*@ assert whatever: promoting ==>
      @     turn(s, a) == a->all_us + 2 * s->config.guard_us + longest_us;
      @*/
    /*@ assert ISO_001: !promoting ==> s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us -
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre) <=
      @     a->all_us - s->queue.budget_us[s->queue.order[s->running]] + s->config.guard_us;
      @*/
    /*@ assert ISO_001_unskipped: !promoting ==> s->stage == KEEL_STAGE_REALTIME ==>
      @     s->queue.skipped[s->queue.order[s->running]] ==
      @         \at(s->queue.skipped[s->queue.order[\at(s->running, Here)]], Pre);
      @*/
    /*@ assert ISO_002: promoting ==> s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us -
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre) <=
      @     a->all_us + 2 * s->config.guard_us + longest_us;
      @*/
    /*@ assert ISO_002_held: promoting ==> s->stage == KEEL_STAGE_REALTIME ==>
      @     a->all_us + 2 * s->config.guard_us + longest_us <=
      @         s->queue.period_us[s->queue.order[s->running]] ==>
      @     s->clock.now_us -
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre) <=
      @     a->all_us - s->queue.budget_us[s->queue.order[s->running]]
      @         + 2 * s->config.guard_us + longest_us;
      @*/
    /*@ assert ISO_002_unskipped: promoting ==> s->stage == KEEL_STAGE_REALTIME ==>
      @     a->all_us + 2 * s->config.guard_us + longest_us <=
      @         s->queue.period_us[s->queue.order[s->running]] ==>
      @     s->queue.skipped[s->queue.order[s->running]] ==
      @         \at(s->queue.skipped[s->queue.order[\at(s->running, Here)]], Pre);
      @*/
    /*@ assert ISO_003: s->stage == KEEL_STAGE_REALTIME ==>
      @     s->clock.now_us -
      @         \at(s->queue.release_us[s->queue.order[\at(s->running, Here)]], Pre) <=
      @     a->bound_us[s->queue.order[s->running]];
      @*/
    /*@ assert ISO_003_unskipped: s->stage == KEEL_STAGE_REALTIME ==>
      @     a->steady[s->queue.order[s->running]] != 0 ==>
      @     s->queue.skipped[s->queue.order[s->running]] ==
      @         \at(s->queue.skipped[s->queue.order[\at(s->running, Here)]], Pre);
      @*/
    if (s->stage != KEEL_STAGE_READY) {
        run_us = longest_run(s, promoting, longest_us);
    }
    /*@ assert held: s->stage == KEEL_STAGE_OTHER ==> promoting || !\at(promotion_due(s), Pre) ==>
      @     held(s, a, run_us);
      @*/
    return run_us;
}

/* One call of the kernel: the one that the stage asks for. Returns how long the task may run that
 * it hands out. */
/*@ SET_GIVEN(s, a)
  @ requires kept: stage_kept(s, a, run_us);
  @ requires other: a->other_us == (promoting ? s->config.guard_us + longest_us : 0);
  @ requires none: !promoting ==> none_counted(s, a);
  @ assigns *s;
  @ SET_STAYS(s, a)
  @ ensures none: !promoting ==> none_counted(s, a);
  @ ensures kept: promoting || !\old(s->stage == KEEL_STAGE_PASS && promotion_due(s)) ||
  @     s->stage != KEEL_STAGE_OTHER ==> stage_kept(s, a, \result);
  @*/
static uint64_t move_on(keel_scheduler_t *s, const account_t *a, bool promoting,
                        uint32_t longest_us, uint64_t run_us)
{
    if (s->stage == KEEL_STAGE_READY) {
        open_pass(s, a);
        return 0u;
    }
    if (s->stage == KEEL_STAGE_REALTIME) {
        run_realtime(s, a, run_us);
        return 0u;
    }
    if (s->stage == KEEL_STAGE_OTHER) {
        run_other(s, a, run_us);
        return 0u;
    }
    return serve(s, a, promoting, longest_us);
}

/* The task at a position leaves. */
/*@ requires memory: \valid(s) && scheduler_valid(s);
  @ requires at: is_at(s, k, task) && task != \null;
  @ assigns s->queue.count, s->queue.realtime_count, s->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns s->cursor, s->pass_end, s->running, s->wake_us, s->earliest_realtime_us,
  @     s->earliest_other_us;
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures guard: s->config.guard_us == \old(s->config.guard_us);
  @ ensures counts: s->queue.count == \old(s->queue.count) - 1;
  @ ensures realtime: s->queue.realtime_count == \old(s->queue.realtime_count)
  @     - ((k < \old(s->queue.realtime_count)) ? 1 : 0);
  @ ensures order: \forall integer j; 0 <= j < s->queue.count ==>
  @     s->queue.order[j] == \at(s->queue.order[(j < k) ? j : j + 1], Pre);
  @ ensures releases: \forall integer j; 0 <= j < s->queue.count ==>
  @     s->queue.release_us[s->queue.order[j]] ==
  @         \at(s->queue.release_us[s->queue.order[(j < k) ? j : j + 1]], Pre);
  @ ensures periods: \forall integer j; 0 <= j < s->queue.count ==>
  @     s->queue.period_us[s->queue.order[j]] ==
  @         \at(s->queue.period_us[s->queue.order[(j < k) ? j : j + 1]], Pre);
  @ ensures budgets: \forall integer j; 0 <= j < s->queue.count ==>
  @     s->queue.budget_us[s->queue.order[j]] ==
  @         \at(s->queue.budget_us[s->queue.order[(j < k) ? j : j + 1]], Pre);
  @*/
static void remove_at(keel_scheduler_t *s, const keel_task_config_t *task, uint32_t k)
{
    keel_status_t status;

    (void)k;
    //@ assert held: queue_holds(&s->queue, task);
    status = keel_scheduler_remove(s, task);
    (void)status;
    //@ assert left: order_left{Pre, Here}(&s->queue, k);
    /*@ assert before: \forall integer j; 0 <= j < k ==>
      @     s->queue.order[j] == \at(s->queue.order[j], Pre);
      @*/
    /*@ assert behind: \forall integer j; k <= j < s->queue.count ==>
      @     s->queue.order[j] == \at(s->queue.order[j + 1], Pre);
      @*/
    /*@ assert slots: \forall integer j; 0 <= j < s->queue.count ==>
      @     0 <= s->queue.order[j] < KEEL_QUEUE_CAPACITY;
      @*/
}

/* The n budgets without the one at position k, if there is one: the sums of those that are left. */
/*@ requires room: \valid(a);
  @ requires many: n <= KEEL_QUEUE_CAPACITY;
  @ requires rise: a->sum[0] == 0 && sums_rise(a, n);
  @ requires range: a->sum[n] <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
  @ assigns a->sum[0 .. KEEL_QUEUE_CAPACITY];
  @ ensures budgets: \forall integer j; 0 <= j < ((k < n) ? n - 1 : n) ==>
  @     a->sum[j + 1] - a->sum[j] ==
  @         \at(a->sum[((j < k) ? j : j + 1) + 1] - a->sum[(j < k) ? j : j + 1], Pre);
  @ ensures lower: \forall integer j; 0 <= j < ((k < n) ? n - 1 : n) ==>
  @     a->sum[j + 1] <= \at(a->sum[((j < k) ? j : j + 1) + 1], Pre);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, (k < n) ? n - 1 : n);
  @ ensures all: a->sum[(k < n) ? n - 1 : n] <= \at(a->sum[n], Pre);
  @*/
static void sum_without(account_t *a, uint32_t k, uint32_t n)
{
    int64_t budget_us;

    if (k >= n) {
        return;
    }
    budget_us = a->sum[k + 1u] - a->sum[k];
    /*@ loop invariant range: k + 1 <= i <= n;
      @ loop invariant lower: \forall integer j; k + 1 <= j < i ==>
      @     a->sum[j] == \at(a->sum[j + 1], Pre) - budget_us;
      @ loop invariant before: \forall integer j; 0 <= j <= k ==>
      @     a->sum[j] == \at(a->sum[j], Pre);
      @ loop invariant same: \forall integer j; i <= j <= n ==>
      @     a->sum[j] == \at(a->sum[j], Pre);
      @ loop assigns i, a->sum[k + 1 .. n - 1];
      @ loop variant n - i;
      @*/
    for (uint32_t i = k + 1u; i < n; i++) {
        //@ assert next: 0 <= a->sum[i + 1] <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
        a->sum[i] = a->sum[i + 1u] - budget_us;
    }
    /*@ assert shifted: \forall integer j; k <= j < n ==>
      @     a->sum[j] == \at(a->sum[j + 1], Pre) - budget_us;
      @*/
}

/* A task leaves: no other is later for it. */
/*@ SET_GIVEN(s, a)
  @ requires ready: s->stage == KEEL_STAGE_READY && late_between(s, a);
  @ requires range: a->all_us <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
  @ requires other: a->other_us <= 2 * UINT32_MAX;
  @ requires room: \valid(a);
  @ requires at: is_at(s, k, task) && task != \null;
  @ assigns s->queue.count, s->queue.realtime_count, s->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns s->cursor, s->pass_end, s->running, s->wake_us, s->earliest_realtime_us,
  @     s->earliest_other_us, a->sum[0 .. KEEL_QUEUE_CAPACITY];
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures guard: s->config.guard_us == \old(s->config.guard_us);
  @ ensures summed: budgets_summed(s, a);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ ensures own: own_counted(s, a);
  @ ensures least: own_least(s, a);
  @ ensures all: all_counted(s, a);
  @ ensures bounded: bounded(s, a);
  @ ensures steady: steadied(s, a);
  @ ensures none: \old(none_counted(s, a)) ==> none_counted(s, a);
  @ ensures never: still_never{Pre, Post}(s);
  @ ensures late: late_between(s, a);
  @*/
static void leave(keel_scheduler_t *s, account_t *a, const keel_task_config_t *task, uint32_t k)
{
    const uint32_t n = s->queue.realtime_count;
    const int64_t turn_us = a->all_us + (int64_t)s->config.guard_us + a->other_us;

    (void)turn_us;
    /*@ assert given: \forall integer j; 0 <= j < n ==> a->own[s->queue.order[j]] ==
      @     ((turn_us <= s->queue.period_us[s->queue.order[j]])
      @          ? 0 : s->queue.budget_us[s->queue.order[j]]);
      @*/
    //@ assert last: 0 <= a->sum[n] <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
    sum_without(a, k, n);
    /*@ assert kept: \forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
      @     a->own[x] == \at(a->own[x], Pre) && a->bound_us[x] == \at(a->bound_us[x], Pre) &&
      @     a->steady[x] == \at(a->steady[x], Pre);
      @*/
    /*@ assert summed: \forall integer j; 0 <= j < ((k < n) ? n - 1 : n) ==>
      @     a->sum[j + 1] - a->sum[j] ==
      @         s->queue.budget_us[s->queue.order[(j < k) ? j : j + 1]];
      @*/
    /*@ assert late: \forall integer j; 0 <= j < ((k < n) ? n - 1 : n) ==>
      @     s->clock.now_us - s->queue.release_us[s->queue.order[(j < k) ? j : j + 1]] <=
      @         a->all_us + a->other_us - a->sum[j + 1]
      @         + a->own[s->queue.order[(j < k) ? j : j + 1]];
      @*/
    remove_at(s, task, k);
    //@ assert counts: s->queue.realtime_count == ((k < n) ? n - 1 : n);
    //@ assert time: s->clock.now_us == \at(s->clock.now_us, Pre);
    /*@ assert own_moved: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     a->own[s->queue.order[j]] == a->own[\at(s->queue.order[(j < k) ? j : j + 1], Pre)];
      @*/
    /*@ assert moved: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->queue.release_us[s->queue.order[j]] ==
      @         \at(s->queue.release_us[s->queue.order[(j < k) ? j : j + 1]], Pre);
      @*/
    /*@ assert bounds: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     \at(s->clock.now_us - s->queue.release_us[s->queue.order[(j < k) ? j : j + 1]], Pre) <=
      @         a->all_us + a->other_us - a->sum[j + 1]
      @         + a->own[\at(s->queue.order[(j < k) ? j : j + 1], Pre)];
      @*/
    /*@ assert so_late: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->clock.now_us
      @         - \at(s->queue.release_us[s->queue.order[(j < k) ? j : j + 1]], Pre) <=
      @     a->all_us + a->other_us - a->sum[j + 1] + a->own[s->queue.order[j]];
      @*/
    /*@ assert on_time: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     s->clock.now_us - s->queue.release_us[s->queue.order[j]] <=
      @         a->all_us + a->other_us - a->sum[j + 1] + a->own[s->queue.order[j]];
      @*/
    //@ assert turn: turn(s, a) == turn_us == \at(turn(s, a), Pre);
    /*@ assert there: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     0 <= ((j < k) ? j : j + 1) < n;
      @*/
    /*@ assert taken: \forall integer j; 0 <= j < s->queue.realtime_count ==>
      @     a->own[s->queue.order[j]] == ((turn_us <= s->queue.period_us[s->queue.order[j]])
      @                                       ? 0 : s->queue.budget_us[s->queue.order[j]]);
      @*/
}

/* Between passes the task at any position leaves, or none. */
/*@ SET_GIVEN(s, a)
  @ requires kept: stage_kept(s, a, run_us);
  @ requires range: a->all_us <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
  @ requires other: a->other_us <= 2 * UINT32_MAX;
  @ requires room: \valid(a);
  @ assigns s->queue.count, s->queue.realtime_count, s->queue.order[0 .. KEEL_QUEUE_CAPACITY - 1],
  @     s->queue.task[0 .. KEEL_QUEUE_CAPACITY - 1];
  @ assigns s->cursor, s->pass_end, s->running, s->wake_us, s->earliest_realtime_us,
  @     s->earliest_other_us, a->sum[0 .. KEEL_QUEUE_CAPACITY];
  @ SCHEDULER_STAYS_VALID(s)
  @ ensures wake: wake_right(s);
  @ ensures guard: s->config.guard_us == \old(s->config.guard_us);
  @ ensures summed: budgets_summed(s, a);
  @ ensures rise: a->sum[0] == 0 && sums_rise(a, s->queue.realtime_count);
  @ ensures own: own_counted(s, a);
  @ ensures least: own_least(s, a);
  @ ensures all: all_counted(s, a);
  @ ensures bounded: bounded(s, a);
  @ ensures steady: steadied(s, a);
  @ ensures none: \old(none_counted(s, a)) ==> none_counted(s, a);
  @ ensures never: still_never{Pre, Post}(s);
  @ ensures kept: stage_kept(s, a, run_us);
  @*/
static void let_go(keel_scheduler_t *s, account_t *a, uint64_t run_us)
{
    const uint32_t k = any_number();

    (void)run_us;
    if ((s->stage == KEEL_STAGE_READY) && (k < s->queue.count)) {
        leave(s, a, s->queue.task[s->queue.order[k]], k);
    }
}

/*@ // As keel_scheduler_init and keel_scheduler_add leave it.
  @ requires memory: \valid(s) && scheduler_valid(s) && setup_unmoved(s);
  @ requires clock: clock_modelled(s);
  @ requires fresh: s->wake_us == 0 && s->busy_us == 0;
  @ assigns *s;
  @*/
void isolation(keel_scheduler_t *s, bool promoting, uint32_t longest_us, uint64_t moves)
{
    account_t a;
    bool promotes;
    uint64_t run_us = 0u;

    if (prepare(s, &a, promoting, longest_us) != KEEL_OK) {
        //@ assert refused: !scheduler_holds(s);
        return;
    }
    promotes = may_promote(s);
    if (start(s, &a) != KEEL_OK) {
        return;
    }
    //@ assert none: !promoting ==> none_counted(s, &a);
    /*@ loop invariant memory: \valid(s) && scheduler_valid(s);
      @ loop invariant wake: wake_right(s);
      @ loop invariant busy: s->busy_us <= s->clock.now_us;
      @ loop invariant summed: budgets_summed(s, &a);
      @ loop invariant rise: a.sum[0] == 0 && sums_rise(&a, s->queue.realtime_count);
      @ loop invariant own: own_counted(s, &a);
      @ loop invariant least: own_least(s, &a);
      @ loop invariant all: all_counted(s, &a);
      @ loop invariant none: !promoting ==> none_counted(s, &a);
      @ loop invariant bounded: bounded(s, &a);
      @ loop invariant steady: steadied(s, &a);
      @ loop invariant never: promotes == 0 ==> never_promotes(s);
      @ loop invariant range: a.all_us <= KEEL_QUEUE_CAPACITY * UINT32_MAX;
      @ loop invariant more: a.other_us == (promoting ? s->config.guard_us + longest_us : 0);
      @ loop invariant kept: stage_kept(s, &a, run_us);
      @ loop assigns move, run_us, *s, a.sum[0 .. KEEL_QUEUE_CAPACITY];
      @ loop variant moves - move;
      @*/
    for (uint64_t move = 0u; move < moves; move++) {
        bool ends;

        if (s->clock.now_us > (KEEL_CLOCK_TIME_LIMIT_US - KEEL_CLOCK_STEP_LIMIT_US)) {
            return;
        }
        let_go(s, &a, run_us);
        //@ assert time: in_uptime(s);
        ends = !promoting && (s->stage == KEEL_STAGE_PASS) && is_promotion_due(s);
        //@ assert ISO_003_never: promotes == 0 ==> !ends;
        run_us = move_on(s, &a, promoting, longest_us, run_us);
        if (ends && (s->stage == KEEL_STAGE_OTHER)) {
            return;
        }
    }
}
