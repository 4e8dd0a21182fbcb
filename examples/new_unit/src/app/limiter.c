/* SPDX-License-Identifier: Apache-2.0 */
#include "app/limiter.h"

void limiter_init(limiter_t *limiter, uint16_t limit)
{
    limiter->limit = limit;
    limiter->count = 0u;
}

uint16_t limiter_step(limiter_t *limiter, uint16_t value)
{
    uint16_t passed = value;

    if (value > limiter->limit) {
        passed = limiter->limit;
        if (limiter->count < LIMITER_COUNT_MAX) {
            limiter->count++;
        }
    }
    return passed;
}
