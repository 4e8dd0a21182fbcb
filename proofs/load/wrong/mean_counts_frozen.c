// harness: keel_stats_record_harness
// expect: LOD_003_frozen
//
// A full mean counts on, until the count wraps.
#include "keel/rtos/load.h"

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
    if ((stats->total_us <= (UINT64_MAX - elapsed_us))) {
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

void keel_load_begin(keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    load->start_us = now_us;
    load->busy_us = busy_us;
}

uint32_t keel_load_milli_percent(const keel_load_t *load, uint64_t now_us, uint64_t busy_us)
{
    const uint64_t window_us = now_us - load->start_us;

    if (window_us == 0u) {
        return 0u;
    }
    return (uint32_t)(((busy_us - load->busy_us) * KEEL_LOAD_FULL) / window_us);
}

static uint64_t distance_us(uint64_t a, uint64_t b)
{
    return (a >= b) ? (a - b) : (b - a);
}

keel_status_t keel_deviation_add(keel_deviation_t *deviation, uint64_t start_us, uint32_t period_us)
{
    uint64_t off_us = 0u;

    if (deviation->starts == UINT32_MAX) {
        return KEEL_ERR_STATE;
    }
    if (deviation->starts > 0u) {
        off_us = distance_us(start_us - deviation->start_us, period_us);
        if (off_us > UINT32_MAX) {
            return KEEL_ERR_STATE;
        }
    }
    if (deviation->sum_us2 > (UINT64_MAX - (off_us * off_us))) {
        return KEEL_ERR_STATE;
    }
    deviation->sum_us2 += off_us * off_us;
    deviation->starts++;
    deviation->start_us = start_us;
    return KEEL_OK;
}

uint64_t keel_deviation_variance_us2(const keel_deviation_t *deviation)
{
    if (deviation->starts < 2u) {
        return 0u;
    }
    return deviation->sum_us2 / (deviation->starts - 1u);
}
