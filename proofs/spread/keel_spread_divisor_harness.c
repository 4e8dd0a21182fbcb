// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17
// cbmc: --unwindset keel_spread_divisor.0:8
// sources: src/rtos/spread.c specs/model/spread.c
// covers: keel_spread_divisor model_spread_divisor
//
// Bounded to numbers of 4 bits. The contract under WP has no bound and determines the result.
#include "spread_contracts.h"

void keel_spread_divisor_harness(void)
{
    const uint32_t a = any_bits(4u);
    const uint32_t b = any_bits(4u);
    uint32_t divisor;

    __CPROVER_assume(keel_spread_divisor_may(a, b));

    divisor = keel_spread_divisor(a, b);

    __CPROVER_assert(keel_spread_divisor_does(divisor, a, b),
                     "SPR_004_contract: as its callers take it");
    __CPROVER_assert(divisor == model_spread_divisor(a, b), "SPR_004_divisor: as the model says");
}
