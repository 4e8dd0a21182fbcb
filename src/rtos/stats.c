/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/rtos/stats.h"

/*@ assigns \nothing;
  @ ensures \result == counted(value, UINT16_MAX);
  @*/
static uint16_t count_one(uint16_t value)
{
    return (value < UINT16_MAX) ? (uint16_t)(value + 1u) : value;
}

/* Remembers an overrun for so many runs within the budget as are said. */
/*@ requires \valid(stats);
  @ assigns stats->remembered_us, stats->forgotten_in;
  @ ensures remembered: stats->remembered_us == \max(\old(stats->remembered_us), elapsed_us);
  @ ensures left: stats->forgotten_in == KEEL_STATS_FORGET_RUNS;
  @*/
static void remember_overrun(keel_stats_t *stats, uint32_t elapsed_us)
{
    stats->forgotten_in = KEEL_STATS_FORGET_RUNS;
    if (elapsed_us > stats->remembered_us) {
        stats->remembered_us = elapsed_us;
    }
}

/* Counts a run within the budget, and forgets behind the last of so many. */
/*@ requires \valid(stats);
  @ assigns stats->remembered_us, stats->forgotten_in;
  @ ensures remembered: stats->remembered_us ==
  @     ((\old(stats->forgotten_in) > 1) ? \old(stats->remembered_us) : 0);
  @ ensures left: stats->forgotten_in ==
  @     ((\old(stats->forgotten_in) > 1) ? \old(stats->forgotten_in) - 1 : 0);
  @*/
static void count_down(keel_stats_t *stats)
{
    if (stats->forgotten_in > 1u) {
        stats->forgotten_in--;
    } else {
        stats->forgotten_in = 0u;
        stats->remembered_us = 0u;
    }
}

void keel_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    stats->last_us = elapsed_us;
    if (elapsed_us > stats->longest_us) {
        stats->longest_us = elapsed_us;
    }
    if (elapsed_us > budget_us) {
        stats->overruns = count_one(stats->overruns);
        remember_overrun(stats, elapsed_us);
    } else {
        count_down(stats);
    }
    if ((stats->runs < UINT32_MAX) && (stats->total_us <= (UINT64_MAX - elapsed_us))) {
        stats->runs++;
        stats->total_us += elapsed_us;
    }
}

void keel_stats_promote(keel_stats_t *stats)
{
    stats->promotions = count_one(stats->promotions);
}

uint64_t keel_stats_mean_us(const keel_stats_t *stats)
{
    return (stats->runs == 0u) ? 0u : (stats->total_us / stats->runs);
}
