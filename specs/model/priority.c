#include "priority.h"

/* Whether sp * age >= k * T. As sp is 1 at least, an age of k * T is enough; below it the product
 * fits 64 bits. */
static bool reaches(uint32_t sp, uint64_t age_us, uint32_t k, uint32_t period_us)
{
    const uint64_t multiple_us = (uint64_t)k * period_us;

    return (age_us >= multiple_us) || ((sp * age_us) >= multiple_us);
}

/* PRI-001, eq. 3: 1 + sp * age / T, rounded down, is one more for every k * T, k from 1 on, that
 * sp * age reaches. It saturates at the maximum (PRI-002), so that k ends one before. */
uint32_t model_priority_dynamic(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    uint32_t priority = 1u;

    for (uint32_t k = 1u; k < KEEL_PRIORITY_REALTIME; k++) {
        if (reaches(sp, age_us, k, period_us)) {
            priority++;
        }
    }
    return priority;
}

/* PRI-004: when eq. 3 has saturated. */
bool model_priority_promoted(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    return model_priority_dynamic(sp, age_us, period_us) == KEEL_PRIORITY_REALTIME;
}

/* PRI-004: (max - 1) * T / sp, rounded up. */
uint64_t model_priority_promotion_age_us(uint32_t sp, uint32_t period_us)
{
    const uint64_t limit_us = ((uint64_t)KEEL_PRIORITY_REALTIME - 1u) * period_us;
    const uint64_t whole_us = limit_us / sp;

    return ((limit_us % sp) == 0u) ? whole_us : (whole_us + 1u);
}
