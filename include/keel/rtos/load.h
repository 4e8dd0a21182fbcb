/**
 * @file load.h
 * @brief How much time tasks take: statistics per task, CPU load, and period deviation.
 *
 * Everything is integer arithmetic; what saturates says so in its comment and stops exactly at
 * its limit.
 */
#ifndef KEEL_RTOS_LOAD_H
#define KEEL_RTOS_LOAD_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdint.h>

KEEL_C_BEGIN

/** Statistics of one task's runs (fig. 4). All zero at first. */
typedef struct keel_stats {
    uint64_t total_us;   /**< Sum of the counted runs' execution times, in us. */
    uint32_t runs;       /**< Counted runs; stays at UINT32_MAX, then the mean is frozen. */
    uint32_t last_us;    /**< The last run, in us. */
    uint32_t longest_us; /**< The longest run, in us. */
    uint16_t overruns;   /**< Runs longer than the budget; stays at UINT16_MAX. */
    uint16_t promotions; /**< Times it was served by promotion; stays at UINT16_MAX. */
} keel_stats_t;

/* The parts of statistics for an assigns clause: a structure named as a whole would count as
 * written anywhere in it, which costs provers far more than six fields. */
#define STATS_FIELDS(stats)                                                                        \
    (stats).total_us, (stats).runs, (stats).last_us, (stats).longest_us, (stats).overruns,         \
        (stats).promotions

/* Those of them that a run writes. */
#define STATS_RUN(stats)                                                                           \
    (stats).total_us, (stats).runs, (stats).last_us, (stats).longest_us, (stats).overruns

/*@ predicate stats_fresh(keel_stats_t stats) =
  @     stats.total_us == 0 && stats.runs == 0 && stats.last_us == 0 &&
  @     stats.longest_us == 0 && stats.overruns == 0 && stats.promotions == 0;
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
  @     \at(stats->overruns, M) == \at(stats->overruns, L) &&
  @     \at(stats->runs, M) == \at(stats->runs, L) &&
  @     \at(stats->total_us, M) == \at(stats->total_us, L);
  @*/

/**
 * Records one run of a task (requirements LOD-001 to LOD-003).
 *
 * @param stats      the task's statistics
 * @param elapsed_us how long the run took, in us
 * @param budget_us  the task's declared budget, in us; a longer run is an overrun
 */
/*@ requires \valid(stats);
  @ assigns STATS_RUN(*stats);
  @ ensures LOD_001_last: stats->last_us == elapsed_us;
  @ ensures LOD_001_longest: stats->longest_us == \max(\old(stats->longest_us), elapsed_us);
  @ ensures LOD_002: stats->overruns == ((elapsed_us > budget_us)
  @     ? counted(\old(stats->overruns), UINT16_MAX) : \old(stats->overruns));
  @ ensures LOD_003_recorded: stats_recorded{Pre, Post}(stats, elapsed_us, budget_us);
  @ behavior open:
  @   assumes stats_open(*stats, elapsed_us);
  @   ensures LOD_003_runs: stats->runs == \old(stats->runs) + 1;
  @   ensures LOD_003_total: stats->total_us == \old(stats->total_us) + elapsed_us;
  @ behavior frozen:
  @   assumes !stats_open(*stats, elapsed_us);
  @   ensures LOD_003_frozen: stats->runs == \old(stats->runs)
  @                           && stats->total_us == \old(stats->total_us);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
void keel_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us);

/**
 * Counts that a task was served by promotion (requirement LOD-004).
 *
 * @param stats the task's statistics
 */
/*@ requires \valid(stats);
  @ assigns stats->promotions;
  @ ensures LOD_004: stats->promotions == counted(\old(stats->promotions), UINT16_MAX);
  @*/
void keel_stats_promote(keel_stats_t *stats);

/**
 * The mean run of a task (requirement LOD-005).
 *
 * @param stats the task's statistics
 * @return the mean over the counted runs, rounded down, in us; 0 before the first run
 */
/*@ requires \valid_read(stats);
  @ assigns \nothing;
  @ ensures LOD_005_none: stats->runs == 0 ==> \result == 0;
  @ ensures LOD_005_mean: stats->runs > 0 ==> \result == stats->total_us / stats->runs;
  @*/
uint64_t keel_stats_mean_us(const keel_stats_t *stats);

/** A load of 100 %, in thousandths of a percent. */
#define KEEL_LOAD_FULL 100000u

/** A window over which the CPU's load is measured (eq. 13 and 14). */
typedef struct keel_load {
    uint64_t start_us; /**< When the window began, in us. */
    uint64_t busy_us;  /**< The scheduler's busy time at that moment, in us. */
} keel_load_t;

/**
 * Begins a window (requirement LOD-006).
 *
 * @param load    the window
 * @param now_us  the time, in us
 * @param busy_us the time spent in tasks so far, in us
 */
/*@ requires \valid(load);
  @ assigns *load;
  @ ensures LOD_006: load->start_us == now_us && load->busy_us == busy_us;
  @*/
void keel_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us);

/**
 * The CPU's load since the window began, U = 100 - I with I = 100 T_nl / T (eq. 13 and 14,
 * requirement LOD-007). All that is not spent in tasks counts as idle, the scheduler included.
 *
 * @param load    the window
 * @param now_us  the time, not before the window's start and less than 2^32 us after it
 * @param busy_us the time spent in tasks so far: what the window adds is at most its length
 * @return the load in thousandths of a percent, rounded down, 0 to KEEL_LOAD_FULL; 0 for an
 *         empty window
 */
/*@ requires \valid_read(load);
  @ requires load->start_us <= now_us && now_us - load->start_us <= UINT32_MAX;
  @ requires load->busy_us <= busy_us && busy_us - load->busy_us <= now_us - load->start_us;
  @ assigns \nothing;
  @ ensures LOD_007_range: \result <= KEEL_LOAD_FULL;
  @ ensures LOD_007_empty: now_us == load->start_us ==> \result == 0;
  @ ensures LOD_007_load: now_us > load->start_us ==> \result ==
  @     ((busy_us - load->busy_us) * KEEL_LOAD_FULL) / (now_us - load->start_us);
  @*/
uint32_t keel_load_milli_percent(const keel_load_t *load, uint64_t now_us, uint64_t busy_us);

/** How far a task's measured periods lie from their target (eq. 15). All zero at first. */
typedef struct keel_deviation {
    uint64_t sum_us2;  /**< Sum of the squared deviations, in us^2; never wraps. */
    uint64_t start_us; /**< The last start, in us. */
    uint32_t starts;   /**< Starts seen; the first of them ends no period. */
} keel_deviation_t;

/*@ logic integer distance(integer a, integer b) = (a >= b) ? a - b : b - a;
  @
  @ // The square that a start at start_us adds to eq. 15's sum.
  @ logic integer deviation_square(integer last_us, integer start_us, integer period_us) =
  @     distance(start_us - last_us, period_us) * distance(start_us - last_us, period_us);
  @*/

/**
 * Adds a start of the task to the deviation of its period (eq. 15, requirement LOD-008).
 *
 * @param deviation the accumulator
 * @param start_us  when the task started, not before its last start, in us
 * @param period_us the target period, in us
 * @return KEEL_OK, or KEEL_ERR_STATE when the sample would overflow the sum or the count, or
 *         its period lies 2^32 us or more from the target; nothing is added then
 */
/*@ requires \valid(deviation);
  @ requires deviation->starts > 0 ==> deviation->start_us <= start_us;
  @ assigns *deviation;
  @ behavior first:
  @   assumes deviation->starts == 0;
  @   ensures LOD_008_first: \result == KEEL_OK && deviation->starts == 1 &&
  @       deviation->start_us == start_us && deviation->sum_us2 == \old(deviation->sum_us2);
  @ behavior added:
  @   assumes 0 < deviation->starts < UINT32_MAX;
  @   assumes distance(start_us - deviation->start_us, period_us) <= UINT32_MAX;
  @   assumes deviation->sum_us2
  @           + deviation_square(deviation->start_us, start_us, period_us) <= UINT64_MAX;
  @   ensures ok: \result == KEEL_OK;
  @   ensures LOD_008_sum: deviation->sum_us2 == \old(deviation->sum_us2)
  @       + deviation_square(\old(deviation->start_us), start_us, period_us);
  @   ensures LOD_008_start: deviation->start_us == start_us;
  @   ensures LOD_008_starts: deviation->starts == \old(deviation->starts) + 1;
  @ behavior refused:
  @   assumes deviation->starts > 0;
  @   assumes deviation->starts == UINT32_MAX ||
  @       distance(start_us - deviation->start_us, period_us) > UINT32_MAX ||
  @       deviation->sum_us2
  @           + deviation_square(deviation->start_us, start_us, period_us) > UINT64_MAX;
  @   assigns \nothing;
  @   ensures LOD_009: \result == KEEL_ERR_STATE;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                 uint32_t period_us);

/**
 * The mean squared deviation, sigma^2 of eq. 15 (requirement LOD-010). The root is left to whoever
 * prints it, who has floating point.
 *
 * @param deviation the accumulator
 * @return sigma^2 rounded down, in us^2; 0 before the second start
 */
/*@ requires \valid_read(deviation);
  @ assigns \nothing;
  @ ensures LOD_010_none: deviation->starts < 2 ==> \result == 0;
  @ ensures LOD_010_mean: deviation->starts >= 2 ==>
  @     \result == deviation->sum_us2 / (deviation->starts - 1);
  @*/
uint64_t keel_deviation_variance_us2(const keel_deviation_t *deviation);

KEEL_C_END

#endif
