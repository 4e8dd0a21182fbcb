/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/scheduler_state.h
 * @brief The invariants of scheduler_state.h: the words that contracts use.
 */
#ifndef KEEL_INTERNAL_RTOS_SCHEDULER_STATE_H
#define KEEL_INTERNAL_RTOS_SCHEDULER_STATE_H

#include "keel/c_declarations.h"
#include "keel/internal/rtos/admission.h"
#include "keel/internal/rtos/decision.h"
#include "keel/internal/rtos/queue.h"
#include "keel/rtos/scheduler_state.h"

KEEL_C_BEGIN

/*@ predicate stage_running(keel_scheduler_t *s) =
  @     s->stage == KEEL_STAGE_REALTIME || s->stage == KEEL_STAGE_OTHER;
  @
  @ // In a pass the cursor lies within the pass, the pass within the real-time tasks; the running
  @ // task is in the queue; the configuration is as keel_scheduler_init accepted it.
  @ predicate scheduler_state(keel_scheduler_t *s) =
  @     0 <= s->cursor <= s->pass_end <= s->queue.realtime_count &&
  @     KEEL_POSITION_NONE <= s->running < s->queue.count &&
  @     s->config.guard_us < KEEL_PERIOD_LIMIT_US &&
  @     s->config.utilisation_limit_ppm <= KEEL_UTILISATION_FULL_PPM &&
  @     KEEL_STAGE_SETUP <= s->stage <= KEEL_STAGE_OTHER &&
  @     (s->stage >= KEEL_STAGE_PASS ==> s->wake_us == 0);
  @
  @ // The bounds that are remembered of the releases ...
  @ predicate realtime_bound(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < s->queue.realtime_count ==>
  @         s->earliest_realtime_us <= s->queue.release_us[s->queue.order[i]];
  @
  @ predicate other_bound(keel_scheduler_t *s) =
  @     \forall integer i; s->queue.realtime_count <= i < s->queue.count ==>
  @         s->earliest_other_us <= s->queue.release_us[s->queue.order[i]];
  @
  @ // ... and the earliest real-time release itself, as long as it lies ahead.
  @ predicate realtime_exact(keel_scheduler_t *s) =
  @     s->clock.now_us < s->earliest_realtime_us ==>
  @         is_earliest(&s->queue, 0, s->queue.realtime_count, s->earliest_realtime_us);
  @
  @ predicate scheduler_valid(keel_scheduler_t *s) =
  @     queue_counts(&s->queue) && queue_order(&s->queue) && queue_no_gaps(&s->queue) &&
  @     queue_no_duplicates(&s->queue) && queue_realtime_first(&s->queue) &&
  @     queue_others_last(&s->queue) && queue_periods(&s->queue) && queue_budgets(&s->queue) &&
  @     scheduler_state(s) && realtime_bound(s) && other_bound(s) && realtime_exact(s);
  @
  @ // keel_scheduler_init accepts this, besides a clock.
  @ predicate settings_valid(keel_scheduler_config_t *config) =
  @     config->guard_us < KEEL_PERIOD_LIMIT_US &&
  @     config->utilisation_limit_ppm <= KEEL_UTILISATION_FULL_PPM;
  @
  @ predicate config_copied(keel_scheduler_t *s, keel_scheduler_config_t *config) =
  @     s->config.guard_us == config->guard_us &&
  @     s->config.utilisation_limit_ppm == config->utilisation_limit_ppm &&
  @     s->config.without_promotion == config->without_promotion &&
  @     s->config.read_clock == config->read_clock &&
  @     s->config.clock_context == config->clock_context;
  @
  @ // As keel_scheduler_init leaves it: no task, no time, not started, nothing known.
  @ predicate scheduler_fresh(keel_scheduler_t *s) =
  @     s->queue.count == 0 && s->queue.realtime_count == 0 && s->clock.now_us == 0 &&
  @     s->clock.raw_us == 0 && s->busy_us == 0 && s->stage == KEEL_STAGE_SETUP &&
  @     s->cursor == 0 && s->pass_end == 0 && s->running == KEEL_POSITION_NONE &&
  @     s->wake_us == 0 && s->earliest_realtime_us == 0 && s->earliest_other_us == 0;
  @
  @ predicate is_at(keel_scheduler_t *s, integer i, keel_task_config_t *task) =
  @     0 <= i < s->queue.count && s->queue.task[s->queue.order[i]] == task;
  @
  @ // Until the start no time has passed.
  @ predicate setup_unmoved(keel_scheduler_t *s) =
  @     s->stage == KEEL_STAGE_SETUP ==> s->clock.now_us == 0;
  @
  @ // The theorems hold up to this uptime; beyond it the kernel is not proved.
  @ predicate in_uptime(keel_scheduler_t *s) = s->clock.now_us <= KEEL_CLOCK_TIME_LIMIT_US;
  @
  @ // Whether the task at position i may run now, if no real-time task is due.
  @ predicate other_may_run(keel_scheduler_t *s, integer i) =
  @     may_run(&s->queue, s->queue.order[i], s->clock.now_us, s->config.guard_us,
  @             s->config.without_promotion);
  @
  @ predicate due(keel_scheduler_t *s, integer i) =
  @     released(&s->queue, s->queue.order[i], s->clock.now_us);
  @
  @ logic integer priority_at(keel_scheduler_t *s, integer i) =
  @     task_priority(&s->queue, s->queue.order[i], s->clock.now_us);
  @
  @ // The task at position i is taken into service: its release moves on along its grid ...
  @ predicate moved_on{L, M}(keel_scheduler_t *s, integer i) =
  @     \at(s->queue.release_us[s->queue.order[i]], M) ==
  @         \at(grid_next(&s->queue, s->queue.order[i], s->clock.now_us), L) &&
  @     \at(s->queue.skipped[s->queue.order[i]], M) ==
  @         \at(\min(UINT16_MAX, s->queue.skipped[s->queue.order[i]] +
  @                  grid_missed(&s->queue, s->queue.order[i], s->clock.now_us)), L);
  @
  @ // ... or it is not.
  @ predicate left_alone{L, M}(keel_scheduler_t *s, integer i) =
  @     \at(s->queue.release_us[s->queue.order[i]], M) ==
  @         \at(s->queue.release_us[s->queue.order[i]], L) &&
  @     \at(s->queue.skipped[s->queue.order[i]], M) ==
  @         \at(s->queue.skipped[s->queue.order[i]], L);
  @
  @ // All that scheduling reads of declarations and configuration is the same in states
  @ // L and M.
  @ predicate declared_same{L, M}(keel_scheduler_t *s) =
  @     (\forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @         \at(s->queue.period_us[x], M) == \at(s->queue.period_us[x], L)) &&
  @     (\forall integer x; 0 <= x < KEEL_QUEUE_CAPACITY ==>
  @         \at(s->queue.budget_us[x], M) == \at(s->queue.budget_us[x], L)) &&
  @     \at(s->config.guard_us, M) == \at(s->config.guard_us, L) &&
  @     \at(s->config.without_promotion, M) == \at(s->config.without_promotion, L);
  @
  @ logic integer promotions_at(keel_scheduler_t *s, integer i) =
  @     s->queue.stats[s->queue.order[i]].promotions;
  @
  @ // Nothing is due: neither a real-time task, nor another that may run.
  @ predicate nothing_due(keel_scheduler_t *s) =
  @     (\forall integer i; 0 <= i < s->queue.realtime_count ==> !due(s, i)) &&
  @     (\forall integer i; s->queue.realtime_count <= i < s->queue.count ==>
  @         !other_may_run(s, i));
  @
  @ // Why the task at a position, not a real-time one, cannot run before wake_us: it is not
  @ // released before, or does not fit the slack, which only shrinks, and is not promoted before,
  @ // if ever.
  @ predicate waits(keel_scheduler_t *s, integer i) =
  @     s->wake_us <= s->queue.release_us[s->queue.order[i]] ||
  @     ((s->config.without_promotion != 0 ||
  @       s->wake_us <= promotion(&s->queue, s->queue.order[i])) &&
  @      !fits_slack(&s->queue, s->queue.order[i], s->clock.now_us, s->config.guard_us));
  @
  @ // The claim that wake_us makes while it lies ahead: nothing is due before it.
  @ predicate wake_realtime(keel_scheduler_t *s) =
  @     \forall integer i; 0 <= i < s->queue.realtime_count ==>
  @         s->wake_us <= s->queue.release_us[s->queue.order[i]];
  @
  @ predicate wake_others(keel_scheduler_t *s) =
  @     \forall integer i; s->queue.realtime_count <= i < s->queue.count ==> waits(s, i);
  @
  @ predicate wake_right(keel_scheduler_t *s) =
  @     s->clock.now_us < s->wake_us ==> wake_realtime(s) && wake_others(s);
  @*/

/*@ // A rule of admission refuses a set of tasks.
  @ predicate admission_status(integer status) = status == KEEL_ERR_REALTIME_DEMAND ||
  @     status == KEEL_ERR_BUDGET_GAP || status == KEEL_ERR_UTILISATION;
  @
  @ // Nothing is known of the releases, and the next step decides anew.
  @ predicate nothing_known(keel_scheduler_t *s) =
  @     s->wake_us == 0 && s->earliest_realtime_us == 0 && s->earliest_other_us == 0;
  @
  @ // All that starting writes is the same in states L and M.
  @ predicate started_nothing{L, M}(keel_scheduler_t *s) =
  @     \at(s->stage, M) == \at(s->stage, L) &&
  @     \at(s->clock.now_us, M) == \at(s->clock.now_us, L) &&
  @     \at(s->clock.raw_us, M) == \at(s->clock.raw_us, L) &&
  @     \at(s->earliest_realtime_us, M) == \at(s->earliest_realtime_us, L);
  @
  @ // The running task's position when a task of this priority joins the queue ...
  @ predicate running_joined{L, M}(keel_scheduler_t *s, integer priority) =
  @     \at(s->running, M) == \at(s->running, L) +
  @         ((priority == KEEL_PRIORITY_REALTIME &&
  @           \at(s->queue.realtime_count, L) <= \at(s->running, L)) ? 1 : 0);
  @
  @ // ... and the positions of a pass when the task at position i leaves it.
  @ predicate pass_left{L, M}(keel_scheduler_t *s, integer i) =
  @     \at(s->cursor, M) == \at(s->cursor, L) - ((i < \at(s->cursor, L)) ? 1 : 0) &&
  @     \at(s->pass_end, M) == \at(s->pass_end, L) - ((i < \at(s->pass_end, L)) ? 1 : 0) &&
  @     \at(s->running, M) == ((i == \at(s->running, L)) ? KEEL_POSITION_NONE :
  @         \at(s->running, L) - ((i < \at(s->running, L)) ? 1 : 0));
  @
  @ // Adding asks for this, besides admission.
  @ predicate addable(keel_scheduler_t *s, keel_task_config_t *task) =
  @     config_valid(task) && !queue_holds(&s->queue, task) &&
  @     s->queue.count < KEEL_QUEUE_CAPACITY;
  @
  @ // Whether the first n tasks keep the rules of admission, and the first rule that they break.
  @ predicate scheduler_holds_of(keel_scheduler_t *s, integer n) =
  @     set_holds(&s->queue, n, s->config.guard_us, s->config.utilisation_limit_ppm);
  @
  @ predicate scheduler_refused(keel_scheduler_t *s, integer n, integer status) =
  @     set_refused(&s->queue, n, s->config.guard_us, s->config.utilisation_limit_ppm, status);
  @
  @ predicate scheduler_holds(keel_scheduler_t *s) = scheduler_holds_of(s, s->queue.count);
  @
  @ // Whether one more task breaks a rule of admission.
  @ predicate demand_allows(keel_scheduler_t *s, keel_task_config_t *task) =
  @     demand_holds_with(&s->queue, task->priority, task->period_us, task->budget_us,
  @                       s->config.guard_us);
  @
  @ predicate gap_allows(keel_scheduler_t *s, keel_task_config_t *task) =
  @     gap_holds_with(&s->queue, task->priority, task->period_us, task->budget_us,
  @                    s->config.guard_us);
  @
  @ predicate utilisation_allows(keel_scheduler_t *s, keel_task_config_t *task) =
  @     utilisation_holds_with(&s->queue, task->period_us, task->budget_us,
  @                            s->config.utilisation_limit_ppm);
  @
  @ // The first rule of admission that it breaks.
  @ predicate refuses(keel_scheduler_t *s, keel_task_config_t *task, integer status) =
  @     (status == KEEL_ERR_REALTIME_DEMAND && !demand_allows(s, task)) ||
  @     (status == KEEL_ERR_BUDGET_GAP && demand_allows(s, task) && !gap_allows(s, task)) ||
  @     (status == KEEL_ERR_UTILISATION && demand_allows(s, task) && gap_allows(s, task) &&
  @      !utilisation_allows(s, task));
  @
  @ predicate admits(keel_scheduler_t *s, keel_task_config_t *task) =
  @     s->stage == KEEL_STAGE_SETUP || (scheduler_holds(s) && demand_allows(s, task) &&
  @         gap_allows(s, task) && utilisation_allows(s, task));
  @*/

/* clang-format off: the formatter does not know these clauses. */
/* The invariant of a scheduler as one clause for each part, which provers take one at a time. */
#define SCHEDULER_STAYS_VALID(s)                                                                   \
    ensures SCH_006_counts : queue_counts(&(s)->queue);                                            \
    ensures SCH_006_order : queue_order(&(s)->queue);                                              \
    ensures SCH_006_no_gaps : queue_no_gaps(&(s)->queue);                                          \
    ensures SCH_006_no_duplicates : queue_no_duplicates(&(s)->queue);                              \
    ensures SCH_006_realtime : queue_realtime_first(&(s)->queue);                                  \
    ensures SCH_006_others : queue_others_last(&(s)->queue);                                       \
    ensures SCH_006_periods : queue_periods(&(s)->queue);                                          \
    ensures SCH_006_budgets : queue_budgets(&(s)->queue);                                          \
    ensures SCH_006_state : scheduler_state(s);                                                    \
    ensures SCH_006_realtime_bound : realtime_bound(s);                                            \
    ensures SCH_006_other_bound : other_bound(s);                                                  \
    ensures SCH_006_exact : realtime_exact(s);
/* clang-format on */

KEEL_C_END

#endif
