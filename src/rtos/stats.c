/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/rtos/stats.h"

/*@ assigns \nothing;
  @ ensures \result == counted(value, UINT16_MAX);
  @*/
static uint16_t count_one(uint16_t value)
{
    return (value < UINT16_MAX) ? (uint16_t)(value + 1u) : value;
}

void keel_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    stats->last_us = elapsed_us;
    if (elapsed_us > stats->longest_us) {
        stats->longest_us = elapsed_us;
    }
    if (elapsed_us > budget_us) {
        stats->overruns = count_one(stats->overruns);
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
