// wp: theorem
/**
 * The isolation theorem (requirement ISO-001): with no promotion, and execution times within their
 * budgets, a real-time task starts at most the sum of the other real-time budgets plus the guard W
 * after its release. It holds for any admitted set, and for runs of any length.
 *
 * The function below is the life of an admitted set as the kernel's contracts describe it: each
 * statement bears the clause of scheduler.h that it restates, and specs/soundness.md says what
 * joins the two. The world is a function that takes as long as it likes, up to a limit:
 *
 *   - a step begins at most W after the last clock reading;
 *   - a real-time task takes at most its budget;
 *   - another task takes at most its budget, and at most W more for the decision before it.
 *
 * sum[j] is the sum of the first j budgets, total the sum of all. Between steps task j is late by
 * at most total - sum[j + 1], the budgets of the tasks behind it, because only those have run
 * since the pass looked at it. That is the invariant of the outer loop.
 */
#include "keel/rtos/clock.h"
#include "keel/rtos/priority.h"
#include "keel/rtos/queue.h"

#include <stdint.h>

/* More than a step can take, so that the uptime stays in its limit. */
#define STEP_ROOM_US 0x1400000000u

/*@ // The world: something takes time, at most limit_us.
  @ assigns \nothing;
  @ ensures \result <= limit_us;
  @*/
uint64_t elapse(uint64_t limit_us);

/*@ // The time to the earliest release (DEC-002), of releases that all lie ahead.
  @ requires n <= KEEL_QUEUE_CAPACITY && \valid_read(release_us + (0 .. n - 1));
  @ assigns \nothing;
  @ ensures bound: \forall integer j; 0 <= j < n ==>
  @     release_us[j] > now_us ==> \result <= release_us[j] - now_us;
  @ ensures due: \forall integer j; 0 <= j < n ==> release_us[j] <= now_us ==> \result == 0;
  @*/
static uint64_t slack(uint32_t n, const uint64_t *release_us, uint64_t now_us)
{
    uint64_t slack_us = UINT64_MAX;

    /*@ loop invariant range: 0 <= i <= n;
      @ loop invariant bound: \forall integer j; 0 <= j < i ==>
      @     release_us[j] > now_us ==> slack_us <= release_us[j] - now_us;
      @ loop invariant due: \forall integer j; 0 <= j < i ==>
      @     release_us[j] <= now_us ==> slack_us == 0;
      @ loop assigns i, slack_us;
      @ loop variant n - i;
      @*/
    for (uint32_t i = 0u; i < n; i++) {
        const uint64_t time_us = (release_us[i] > now_us) ? (release_us[i] - now_us) : 0u;

        if (time_us < slack_us) {
            slack_us = time_us;
        }
    }
    return slack_us;
}

/*@ predicate prefix_sums(uint64_t *sum, uint32_t *budget_us, integer n) =
  @     \forall integer j; 0 <= j < n ==> sum[j + 1] == sum[j] + budget_us[j];
  @
  @ predicate rising(uint64_t *sum, integer n) =
  @     \forall integer j, k; 0 <= j <= k <= n ==> sum[j] <= sum[k];
  @*/

/*@ requires set: 0 < n <= KEEL_QUEUE_CAPACITY && guard_us < KEEL_PERIOD_LIMIT_US;
  @ requires memory: \valid_read(period_us + (0 .. n - 1)) && \valid_read(budget_us + (0 .. n - 1));
  @ requires memory_release: \valid(release_us + (0 .. n - 1)) && \valid_read(sum + (0 .. n));
  @ requires apart: \separated(release_us + (0 .. n - 1), sum + (0 .. n));
  @ requires sums: sum[0] == 0 && prefix_sums(sum, budget_us, n) && rising(sum, n);
  @ // TSK-002: every budget is above 0.
  @ requires budgets: \forall integer j; 0 <= j < n ==> budget_us[j] > 0;
  @ requires total: sum[n] <= UINT32_MAX;
  @ // ADM-004: every real-time period holds all real-time budgets and the guard twice.
  @ requires admitted: \forall integer j; 0 <= j < n ==> sum[n] + 2 * guard_us <= period_us[j];
  @ // SCH-009: nothing is late at the start.
  @ requires start: \forall integer j; 0 <= j < n ==> release_us[j] >= 0;
  @ assigns release_us[0 .. n - 1];
  @*/
void isolation(uint32_t n, const uint32_t *period_us, const uint32_t *budget_us,
               uint64_t *release_us, const uint64_t *sum, uint32_t guard_us, uint64_t steps)
{
    const uint64_t total = sum[n];
    uint64_t now_us = 0u;

    /*@ loop invariant late: \forall integer j; 0 <= j < n ==>
      @     now_us - release_us[j] <= total - sum[j + 1];
      @ loop assigns step, now_us, release_us[0 .. n - 1];
      @ loop variant steps - step;
      @*/
    for (uint64_t step = 0u; step < steps; step++) {
        uint64_t slack_us;
        uint64_t worst_us;

        if (now_us > (KEEL_CLOCK_TIME_LIMIT_US - STEP_ROOM_US)) {
            return;
        }
        now_us += elapse(guard_us); /* SCH-011: the pass begins. */
        /*@ loop invariant range: 0 <= c <= n;
          @ loop invariant uptime:
          @     now_us <= KEEL_CLOCK_TIME_LIMIT_US - STEP_ROOM_US + guard_us + sum[c];
          @ loop invariant served: \forall integer j; 0 <= j < c ==>
          @     now_us - release_us[j] <= sum[c] - sum[j + 1];
          @ loop invariant unserved: \forall integer j; c <= j < n ==>
          @     now_us - release_us[j] <= guard_us + sum[c] + total - sum[j + 1];
          @ loop assigns c, now_us, release_us[0 .. n - 1];
          @ loop variant n - c;
          @*/
        for (uint32_t c = 0u; c < n; c++) {
            if (release_us[c] <= now_us) { /* SCH-015: due, and the first from the cursor on. */
                //@ assert ISO_001: now_us - release_us[c] <= total - budget_us[c] + guard_us;
                //@ assert on_time: now_us < release_us[c] + period_us[c];
                release_us[c] += period_us[c];  /* SCH-014: the next release on the grid. */
                now_us += elapse(budget_us[c]); /* SCH-017: it ran. */
            }
        }
        /* SCH-016: another task runs only if it fits the slack. */
        slack_us = slack(n, release_us, now_us);
        worst_us = elapse(UINT32_MAX);
        if ((worst_us > 0u) && ((guard_us + worst_us) <= slack_us)) {
            now_us += elapse(guard_us + worst_us);
        }
    }
}
