/**
 * @file priority_contracts.h
 * @brief What the functions of priority.h ask for and do, as expressions of C without a division.
 *
 * Their own harnesses prove that they keep these, for small numbers, and WP for all; in the
 * harnesses of decisions, whose numbers have their full width, these stand in for them.
 */
#ifndef PRIORITY_CONTRACTS_H
#define PRIORITY_CONTRACTS_H

#include "keel/rtos/priority.h"
#include "keel_proof.h"

static bool keel_priority_dynamic_may(uint32_t sp, uint64_t age_us, uint32_t period_us)
{
    (void)age_us;
    return (1u <= sp) && (sp <= KEEL_PRIORITY_REALTIME) && (0u < period_us) &&
           (period_us < KEEL_PERIOD_LIMIT_US);
}

/* Of an age below 2^60 us, so that nothing wraps here. */
static bool keel_priority_dynamic_does(uint32_t priority, uint32_t sp, uint64_t age_us,
                                       uint32_t period_us)
{
    return (age_us >= ((uint64_t)1u << 60)) ||
           (priority == dynamic_priority(sp, age_us, period_us));
}

static bool keel_priority_promotion_age_us_may(uint32_t sp, uint32_t period_us)
{
    return keel_priority_dynamic_may(sp, 0u, period_us);
}

/* The first age at which sp * age reaches 15 T. */
static bool keel_priority_promotion_age_us_does(uint64_t age_us, uint32_t sp, uint32_t period_us)
{
    const uint64_t limit = 15u * (uint64_t)period_us;

    return (0u < age_us) && (age_us <= limit) && ((sp * age_us) >= limit) &&
           ((sp * (age_us - 1u)) < limit);
}

#endif
