/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/rtos/stats.h
 * @brief The contracts of stats.h, and the functions that no user calls.
 */
#ifndef KEEL_INTERNAL_RTOS_STATS_H
#define KEEL_INTERNAL_RTOS_STATS_H

#include "keel/c_declarations.h"
#include "keel/rtos/stats.h"

KEEL_C_BEGIN

/* The parts of statistics for an assigns clause: a structure named as a whole would count as
 * written anywhere in it, which costs provers far more than eight fields. */
#define STATS_FIELDS(stats)                                                                        \
    (stats).total_us, (stats).runs, (stats).last_us, (stats).longest_us, (stats).remembered_us,    \
        (stats).forgotten_in, (stats).overruns, (stats).promotions

/* Those of them that a run writes. */
#define STATS_RUN(stats)                                                                           \
    (stats).total_us, (stats).runs, (stats).last_us, (stats).longest_us, (stats).remembered_us,    \
        (stats).forgotten_in, (stats).overruns

/* Statistics of no run. Not a predicate: provers take each field by itself then. */
#define STATS_FRESH(stats)                                                                         \
    ((stats).total_us == 0 && (stats).runs == 0 && (stats).last_us == 0 &&                         \
     (stats).longest_us == 0 && (stats).remembered_us == 0 && (stats).forgotten_in == 0 &&         \
     (stats).overruns == 0 && (stats).promotions == 0)

/*@ // w: what decisions reckon with.
  @ logic integer stats_worst(integer budget_us, integer remembered_us) =
  @     \max(budget_us, remembered_us);
  @
  @ // The time remembered behind a run, and for how many runs within the budget.
  @ logic integer remembered_after(integer elapsed_us, integer budget_us,
  @                                integer remembered_us, integer forgotten_in) =
  @     (elapsed_us > budget_us) ? \max(remembered_us, elapsed_us)
  @                              : ((forgotten_in > 1) ? remembered_us : 0);
  @
  @ logic integer forgotten_after(integer elapsed_us, integer budget_us, integer forgotten_in) =
  @     (elapsed_us > budget_us) ? KEEL_STATS_FORGET_RUNS
  @                              : ((forgotten_in > 1) ? forgotten_in - 1 : 0);
  @
  @ // Counting that stops at a limit.
  @ logic integer counted(integer value, integer limit) = (value < limit) ? value + 1 : limit;
  @
  @ // Whether one more run can enter the mean.
  @ predicate stats_open(keel_stats_t stats, integer elapsed_us) =
  @     stats.runs < UINT32_MAX && stats.total_us + elapsed_us <= UINT64_MAX;
  @
  @ // One run of a task was recorded: every field that a run writes.
  @ predicate stats_recorded{L, M}(keel_stats_t *stats, integer elapsed_us, integer budget_us) =
  @     \at(stats->last_us, M) == elapsed_us &&
  @     \at(stats->longest_us, M) == \max(\at(stats->longest_us, L), elapsed_us) &&
  @     \at(stats->overruns, M) == ((elapsed_us > budget_us)
  @         ? counted(\at(stats->overruns, L), UINT16_MAX) : \at(stats->overruns, L)) &&
  @     \at(stats->remembered_us, M) == remembered_after(elapsed_us, budget_us,
  @         \at(stats->remembered_us, L), \at(stats->forgotten_in, L)) &&
  @     \at(stats->forgotten_in, M) ==
  @         forgotten_after(elapsed_us, budget_us, \at(stats->forgotten_in, L)) &&
  @     \at(stats->runs, M) == \at(stats->runs, L) +
  @         ((\at(stats->runs, L) < UINT32_MAX &&
  @           \at(stats->total_us, L) + elapsed_us <= UINT64_MAX) ? 1 : 0) &&
  @     \at(stats->total_us, M) == \at(stats->total_us, L) +
  @         ((\at(stats->runs, L) < UINT32_MAX &&
  @           \at(stats->total_us, L) + elapsed_us <= UINT64_MAX) ? elapsed_us : 0);
  @
  @ predicate stats_same{L, M}(keel_stats_t *stats) =
  @     \at(stats->last_us, M) == \at(stats->last_us, L) &&
  @     \at(stats->longest_us, M) == \at(stats->longest_us, L) &&
  @     \at(stats->remembered_us, M) == \at(stats->remembered_us, L) &&
  @     \at(stats->overruns, M) == \at(stats->overruns, L) &&
  @     \at(stats->forgotten_in, M) == \at(stats->forgotten_in, L) &&
  @     \at(stats->runs, M) == \at(stats->runs, L) &&
  @     \at(stats->total_us, M) == \at(stats->total_us, L);
  @*/

/**
 * Records one run of a task (requirements STS-001 to STS-003 and STS-006).
 *
 * @param stats      the task's statistics
 * @param elapsed_us how long the run took, in us
 * @param budget_us  the task's declared budget, in us; a longer run is an overrun
 */
/*@ requires \valid(stats);
  @ assigns STATS_RUN(*stats);
  @ ensures STS_001_last: stats->last_us == elapsed_us;
  @ ensures STS_001_longest: stats->longest_us == \max(\old(stats->longest_us), elapsed_us);
  @ ensures STS_002: stats->overruns == ((elapsed_us > budget_us)
  @     ? counted(\old(stats->overruns), UINT16_MAX) : \old(stats->overruns));
  @ ensures STS_006_overrun: elapsed_us > budget_us ==>
  @     stats->remembered_us == \max(\old(stats->remembered_us), elapsed_us) &&
  @     stats->forgotten_in == KEEL_STATS_FORGET_RUNS;
  @ ensures STS_006_kept: elapsed_us <= budget_us && \old(stats->forgotten_in) > 1 ==>
  @     stats->remembered_us == \old(stats->remembered_us) &&
  @     stats->forgotten_in == \old(stats->forgotten_in) - 1;
  @ ensures STS_006_forgotten: elapsed_us <= budget_us && \old(stats->forgotten_in) <= 1 ==>
  @     stats->remembered_us == 0 && stats->forgotten_in == 0;
  @ ensures STS_006_covers: stats_worst(budget_us, stats->remembered_us) >= elapsed_us;
  @ ensures STS_003_recorded: stats_recorded{Pre, Post}(stats, elapsed_us, budget_us);
  @ behavior open:
  @   assumes stats_open(*stats, elapsed_us);
  @   ensures STS_003_runs: stats->runs == \old(stats->runs) + 1;
  @   ensures STS_003_total: stats->total_us == \old(stats->total_us) + elapsed_us;
  @ behavior frozen:
  @   assumes !stats_open(*stats, elapsed_us);
  @   ensures STS_003_frozen: stats->runs == \old(stats->runs)
  @                           && stats->total_us == \old(stats->total_us);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
void keel_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us);

/**
 * Counts that a task was served by promotion (requirement STS-004).
 *
 * @param stats the task's statistics
 */
/*@ requires \valid(stats);
  @ assigns stats->promotions;
  @ ensures STS_004: stats->promotions == counted(\old(stats->promotions), UINT16_MAX);
  @*/
void keel_stats_promote(keel_stats_t *stats);

/*@ requires \valid_read(stats);
  @ assigns \nothing;
  @ ensures STS_005_none: stats->runs == 0 ==> \result == 0;
  @ ensures STS_005_mean: stats->runs > 0 ==> \result == stats->total_us / stats->runs;
  @*/
uint64_t keel_stats_mean_us(const keel_stats_t *stats);

KEEL_C_END

#endif
