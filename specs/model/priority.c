/* SPDX-License-Identifier: Apache-2.0 */
#include "priority.h"

/* (max - 1) * T: eq. 3 saturates once sp * age reaches it. */
static uint64_t saturation_us(uint32_t period_us)
{
    return ((uint64_t)KEEL_PRIORITY_REALTIME - 1u) * period_us;
}

/* PRI-004: as sp is 1 at least, an age of so much is enough; below it the product fits 64 bits. */
bool model_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    const uint64_t limit_us = saturation_us(period_us);

    return (age_us >= limit_us) || ((sp * age_us) >= limit_us);
}

/* PRI-001 and PRI-002: eq. 3, rounded down and saturated. */
uint32_t model_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    if (model_priority_promoted(sp, age_us, period_us)) {
        return KEEL_PRIORITY_REALTIME;
    }
    return 1u + (uint32_t)((sp * age_us) / period_us);
}

/* PRI-004: (max - 1) * T / sp, rounded up. */
uint64_t model_priority_promotion_age_us(uint32_t sp, uint32_t period_us)
{
    return (saturation_us(period_us) + (sp - 1u)) / sp;
}
