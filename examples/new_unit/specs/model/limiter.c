/* SPDX-License-Identifier: Apache-2.0 */
#include "limiter.h"

void model_limiter_init(limiter_t *limiter, uint16_t limit)
{
    const limiter_t fresh = {limit, 0u};

    *limiter = fresh;
}

uint16_t model_limiter_step(limiter_t *limiter, uint16_t value)
{
    const uint16_t before = limiter->count;
    const bool is_full = before == LIMITER_COUNT_MAX;
    const bool passes = value <= limiter->limit;

    limiter->count = (passes || is_full) ? before : (uint16_t)(before + 1u);
    return passes ? value : limiter->limit;
}
