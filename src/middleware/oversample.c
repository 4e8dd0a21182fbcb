/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/middleware/oversample.h"

#include "keel/middleware/range.h"

#include <stdbool.h>

/* Nothing is in the sum. */
/*@ requires \valid(oversample);
  @ assigns oversample->sum, oversample->least, oversample->most, oversample->count,
  @         oversample->runs;
  @ ensures oversample->count == 0 && oversample->runs == 0 && oversample->sum == 0;
  @ ensures oversample->least == KEEL_OVERSAMPLE_RANGE;
  @ ensures oversample->most == -KEEL_OVERSAMPLE_RANGE;
  @*/
static void begin(keel_oversample_t *oversample)
{
    oversample->sum = 0.0f;
    oversample->least = KEEL_OVERSAMPLE_RANGE;
    oversample->most = -KEEL_OVERSAMPLE_RANGE;
    oversample->count = 0u;
    oversample->runs = 0u;
}

keel_status_t keel_oversample_init(keel_oversample_t *oversample, uint16_t factor)
{
    if (factor == 0u) {
        return KEEL_ERR_FACTOR;
    }
    begin(oversample);
    oversample->factor = factor;
    oversample->missed = 0u;
    oversample->extra = 0u;
    return KEEL_OK;
}

keel_status_t keel_oversample_add(keel_oversample_t *oversample, float value)
{
    if (oversample->runs == UINT16_MAX) {
        return KEEL_ERR_FULL;
    }
    oversample->runs++;
    if (!keel_range_contains(value, -KEEL_OVERSAMPLE_RANGE, KEEL_OVERSAMPLE_RANGE)) {
        return KEEL_ERR_VALUE;
    }
    oversample->sum += value;
    oversample->least = (value < oversample->least) ? value : oversample->least;
    oversample->most = (value > oversample->most) ? value : oversample->most;
    oversample->count++;
    return KEEL_OK;
}

/*@ assigns \nothing;
  @ ensures \result == \min(UINT32_MAX, total + \max(0, larger - smaller));
  @*/
static uint32_t add_excess(uint32_t total, uint16_t larger, uint16_t smaller)
{
    const uint32_t excess = (larger > smaller) ? ((uint32_t)larger - smaller) : 0u;

    return (total <= (UINT32_MAX - excess)) ? (total + excess) : UINT32_MAX;
}

keel_status_t keel_oversample_take(keel_oversample_t *oversample, float *mean)
{
    const bool some = oversample->count > 0u;

    if (some) {
        *mean = keel_range_clamp(oversample->sum / (float)oversample->count, oversample->least,
                                 oversample->most);
    }
    oversample->missed = add_excess(oversample->missed, oversample->factor, oversample->runs);
    oversample->extra = add_excess(oversample->extra, oversample->runs, oversample->factor);
    begin(oversample);
    return some ? KEEL_OK : KEEL_ERR_STATE;
}
