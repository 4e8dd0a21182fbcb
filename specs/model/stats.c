/* SPDX-License-Identifier: Apache-2.0 */
#include "stats.h"

#include <stdbool.h>

void model_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    /* STS-003: a mean that cannot take both the run and its time takes neither. */
    const bool open = (stats->runs < UINT32_MAX) && (elapsed_us <= (UINT64_MAX - stats->total_us));

    if (open) {
        stats->runs = stats->runs + 1u;
        stats->total_us = stats->total_us + elapsed_us;
    }
    /* STS-001 */
    stats->last_us = elapsed_us;
    if (stats->longest_us < elapsed_us) {
        stats->longest_us = elapsed_us;
    }
    /* STS-002 */
    if ((elapsed_us > budget_us) && (stats->overruns < UINT16_MAX)) {
        stats->overruns++;
    }
    /* STS-006: so many runs are left within the budget; behind the last nothing is remembered. */
    if (elapsed_us > budget_us) {
        stats->forgotten_in = KEEL_STATS_FORGET_RUNS;
    } else if (stats->forgotten_in > 0u) {
        stats->forgotten_in--;
    }
    if (stats->forgotten_in == 0u) {
        stats->remembered_us = 0u;
    } else if ((elapsed_us > budget_us) && (elapsed_us > stats->remembered_us)) {
        stats->remembered_us = elapsed_us;
    }
}

/* STS-004 */
void model_stats_promote(keel_stats_t *stats)
{
    if (stats->promotions < UINT16_MAX) {
        stats->promotions++;
    }
}

/* STS-005 */
uint64_t model_stats_mean_us(const keel_stats_t *stats)
{
    if (stats->runs == 0u) {
        return 0u;
    }
    return stats->total_us / stats->runs;
}
