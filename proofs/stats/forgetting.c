// SPDX-License-Identifier: Apache-2.0
// wp: theorem
/**
 * An overrun is remembered for KEEL_STATS_FORGET_RUNS runs within the budget, and no longer
 * (requirement STS-007), however many runs there are and however long each of them takes.
 *
 * The function `forgetting` records runs of any times, of a task that was just added. The proof
 * knows the contract of keel_stats_record in stats.h and nothing else. With w for the worst-case
 * time that decisions reckon with, after each of the runs:
 *
 *   - w is no shorter than the budget, nor than any of the last KEEL_STATS_FORGET_RUNS runs;
 *   - w is the budget, or the time of one of the runs, so it is no longer than needed;
 *   - w is the budget when the last KEEL_STATS_FORGET_RUNS runs were within it.
 *
 * The invariant: as many runs as were counted down since the last overrun were within the budget.
 * The times are signed, which nothing in the statistics is: provers know memory by its type.
 */
#include "keel/internal/rtos/stats.h"

#include <stdint.h>

/*@ // The runs from one number to another took no longer than a time.
  @ predicate ran_within(int64_t *ran_us, integer first, integer last, integer time_us) =
  @     \forall integer k; 0 <= k && first <= k < last ==> ran_us[k] <= time_us;
  @
  @ // A run among the first took just so long.
  @ predicate one_ran(int64_t *ran_us, integer count, integer time_us) =
  @     \exists integer k; 0 <= k < count && ran_us[k] == time_us;
  @*/

/*@ requires memory: \valid(stats) && \valid_read(ran_us + (0 .. count - 1));
  @ requires times: \forall integer k; 0 <= k < count ==> 0 <= ran_us[k] <= UINT32_MAX;
  @ requires fresh: STATS_FRESH(*stats);
  @ assigns STATS_RUN(*stats);
  @*/
void forgetting(keel_stats_t *stats, const int64_t *ran_us, uint32_t count, uint32_t budget_us)
{
    /*@ loop invariant range: 0 <= i <= count;
      @ loop invariant left: stats->forgotten_in <= KEEL_STATS_FORGET_RUNS;
      @ loop invariant since: ran_within(ran_us,
      @     i - (KEEL_STATS_FORGET_RUNS - stats->forgotten_in), i, budget_us);
      @ loop invariant overrun: stats->forgotten_in > 0 ==>
      @     KEEL_STATS_FORGET_RUNS - stats->forgotten_in < i &&
      @     ran_us[i - 1 - (KEEL_STATS_FORGET_RUNS - stats->forgotten_in)] > budget_us;
      @ loop invariant none: stats->forgotten_in == 0 ==> stats->remembered_us == 0;
      @ loop invariant recent: ran_within(ran_us, i - KEEL_STATS_FORGET_RUNS, i,
      @     stats_worst(budget_us, stats->remembered_us));
      @ loop invariant ran: stats->remembered_us == 0 ||
      @     one_ran(ran_us, i, stats->remembered_us);
      @ loop assigns i, STATS_RUN(*stats);
      @ loop variant count - i;
      @*/
    for (uint32_t i = 0u; i < count; i++) {
        keel_stats_record(stats, (uint32_t)ran_us[i], budget_us);
        //@ assert STS_007_budget: budget_us <= stats_worst(budget_us, stats->remembered_us);
        /*@ assert STS_007_recent: ran_within(ran_us, i + 1 - KEEL_STATS_FORGET_RUNS, i + 1,
          @     stats_worst(budget_us, stats->remembered_us));
          @*/
        /*@ assert STS_007_ran: stats_worst(budget_us, stats->remembered_us) == budget_us ||
          @     one_ran(ran_us, i + 1, stats_worst(budget_us, stats->remembered_us));
          @*/
        /*@ assert STS_007_forgotten: i + 1 >= KEEL_STATS_FORGET_RUNS &&
          @     ran_within(ran_us, i + 1 - KEEL_STATS_FORGET_RUNS, i + 1, budget_us) ==>
          @     stats_worst(budget_us, stats->remembered_us) == budget_us;
          @*/
    }
}
