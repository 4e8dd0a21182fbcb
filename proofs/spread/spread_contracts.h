/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file spread_contracts.h
 * @brief The contract of keel_spread_divisor, for CBMC: what its own harness proves, and what
 *        stands in for it where code that calls it is proved.
 */
#ifndef SPREAD_CONTRACTS_H
#define SPREAD_CONTRACTS_H

#include "../../specs/model/spread.h"
#include "../common/keel_scheduler_proof.h"

static bool keel_spread_divisor_may(uint32_t a, uint32_t b)
{
    return (0u < a) && (a < KEEL_PERIOD_LIMIT_US) && (b < KEEL_PERIOD_LIMIT_US);
}

static bool keel_spread_divisor_does(uint32_t divisor, uint32_t a, uint32_t b)
{
    return divisor == model_spread_divisor(a, b);
}

#endif
