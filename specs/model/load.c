#include "load.h"

#include <stdbool.h>

void model_stats_record(keel_stats_t *stats, uint32_t elapsed_us, uint32_t budget_us)
{
    /* LOD-003: a mean that cannot take both the run and its time takes neither. */
    const bool open = (stats->runs < UINT32_MAX) && (elapsed_us <= (UINT64_MAX - stats->total_us));

    if (open) {
        stats->runs = stats->runs + 1u;
        stats->total_us = stats->total_us + elapsed_us;
    }
    /* LOD-001 */
    stats->last_us = elapsed_us;
    if (stats->longest_us < elapsed_us) {
        stats->longest_us = elapsed_us;
    }
    /* LOD-002 */
    if ((elapsed_us > budget_us) && (stats->overruns < UINT16_MAX)) {
        stats->overruns++;
    }
}

/* LOD-004 */
void model_stats_promote(keel_stats_t *stats)
{
    if (stats->promotions < UINT16_MAX) {
        stats->promotions++;
    }
}

/* LOD-005 */
uint64_t model_stats_mean_us(const keel_stats_t *stats)
{
    if (stats->runs == 0u) {
        return 0u;
    }
    return stats->total_us / stats->runs;
}

/* LOD-006 */
void model_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    load->start_us = now_us;
    load->busy_us = busy_us;
}

/* LOD-007: eq. 13 and 14, whose idle time T_nl is all of the window that is not spent in tasks. */
uint32_t model_load_milli_percent(const keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    const uint64_t window_us = now_us - load->start_us;
    const uint64_t spent_us = busy_us - load->busy_us;

    if (window_us == 0u) {
        return 0u;
    }
    return (uint32_t)((spent_us * KEEL_LOAD_FULL) / window_us);
}

static uint64_t distance(uint64_t a, uint64_t b)
{
    return (a >= b) ? (a - b) : (b - a);
}

keel_status_t model_deviation_add(keel_deviation_t *deviation, uint64_t start_us,
                                  uint32_t period_us)
{
    /* LOD-008: the first start ends no period. */
    const uint64_t off_us = (deviation->starts == 0u)
                                ? 0u
                                : distance(start_us - deviation->start_us, period_us);

    /* LOD-009: neither the count, nor the square, nor the sum may overflow. */
    if ((deviation->starts == UINT32_MAX) || (off_us > UINT32_MAX) ||
        (deviation->sum_us2 > (UINT64_MAX - (off_us * off_us)))) {
        return KEEL_ERR_STATE;
    }
    /* LOD-008: eq. 15 without the root. */
    deviation->sum_us2 = deviation->sum_us2 + (off_us * off_us);
    deviation->start_us = start_us;
    deviation->starts = deviation->starts + 1u;
    return KEEL_OK;
}

/* LOD-010: of so many starts one fewer are ends of a period. */
uint64_t model_deviation_variance_us2(const keel_deviation_t *deviation)
{
    if (deviation->starts < 2u) {
        return 0u;
    }
    return deviation->sum_us2 / (deviation->starts - 1u);
}
