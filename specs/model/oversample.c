/* SPDX-License-Identifier: Apache-2.0 */
#include "oversample.h"

#include "range.h"

/* No sample and no run; the counts of all takes are what they were. */
static void empty(keel_oversample_t *oversample)
{
    oversample->sum = 0.0f;
    oversample->least = KEEL_OVERSAMPLE_RANGE;
    oversample->most = -KEEL_OVERSAMPLE_RANGE;
    oversample->count = 0u;
    oversample->runs = 0u;
}

/* OVS-001 */
keel_status_t model_oversample_init(keel_oversample_t *oversample, uint16_t factor)
{
    if (factor == 0u) {
        return KEEL_ERR_FACTOR;
    }
    empty(oversample);
    oversample->missed = 0u;
    oversample->extra = 0u;
    oversample->factor = factor;
    return KEEL_OK;
}

keel_status_t model_oversample_add(keel_oversample_t *oversample, float value)
{
    if (oversample->runs == UINT16_MAX) {
        return KEEL_ERR_FULL; /* OVS-003: nothing changes. */
    }
    oversample->runs = (uint16_t)(oversample->runs + 1u);
    if (!model_range_contains(value, -KEEL_OVERSAMPLE_RANGE, KEEL_OVERSAMPLE_RANGE)) {
        return KEEL_ERR_VALUE; /* OVS-003: the run is all that is counted. */
    }
    oversample->sum = oversample->sum + value; /* OVS-002 */
    if (value < oversample->least) {
        oversample->least = value;
    }
    if (value > oversample->most) {
        oversample->most = value;
    }
    oversample->count = (uint16_t)(oversample->count + 1u);
    return KEEL_OK;
}

/* A count and what there is of `these` beyond `those`, at most UINT32_MAX. */
static uint32_t with_excess(uint32_t count, uint16_t these, uint16_t those)
{
    const uint64_t more = (these > those) ? ((uint64_t)these - those) : 0u;
    const uint64_t sum = (uint64_t)count + more;

    return (sum < UINT32_MAX) ? (uint32_t)sum : UINT32_MAX;
}

keel_status_t model_oversample_take(keel_oversample_t *oversample, float *mean)
{
    const keel_oversample_t old = *oversample;

    empty(oversample);                                                  /* OVS-005 */
    oversample->missed = with_excess(old.missed, old.factor, old.runs); /* OVS-006 */
    oversample->extra = with_excess(old.extra, old.runs, old.factor);
    if (old.count == 0u) {
        return KEEL_ERR_STATE; /* OVS-004: the mean stays. */
    }
    *mean = model_range_clamp(old.sum / (float)old.count, old.least, old.most); /* OVS-004 */
    return KEEL_OK;
}
