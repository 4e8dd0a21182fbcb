/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file priority_contracts.h
 * @brief What the functions of priority.h ask for, and what a decision takes from them.
 *
 * Their own harnesses prove that they keep these; in the harnesses of decisions, whose numbers have
 * their full width, any function that does stands in for them.
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

/* What a choice takes from it: below a period late, and sp * late below T, it is 1 + sp. */
static bool keel_priority_dynamic_does(uint32_t priority, uint32_t sp, uint64_t age_us,
                                       uint32_t period_us)
{
    const uint64_t late_us = (age_us > period_us) ? (age_us - period_us) : 0u;

    return (1u <= priority) && (priority <= KEEL_PRIORITY_REALTIME) &&
           ((age_us < period_us) || (late_us >= period_us) || ((sp * late_us) >= period_us) ||
            (sp > KEEL_PRIORITY_HIGH) || (priority == (1u + sp)));
}

static bool keel_priority_promotion_age_us_may(uint32_t sp, uint32_t period_us)
{
    return keel_priority_dynamic_may(sp, 0u, period_us);
}

/* A task is promoted within 1 to 15 periods from the release before the one it waits for. */
static bool keel_priority_promotion_age_us_does(uint64_t age_us, uint32_t sp, uint32_t period_us)
{
    return (age_us <= (15u * (uint64_t)period_us)) &&
           ((sp >= KEEL_PRIORITY_REALTIME) || (age_us >= period_us));
}

#endif
