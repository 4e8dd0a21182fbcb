// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --external-sat-solver cadical
// sources: src/rtos/priority.c
// covers: keel_priority_promotion_age_us saturation
//
// Bounded to periods below 2^12 us, where the solver comes to the end of the division; the
// harness of equality with the model has no such bound, nor has the contract under WP.
#include "../common/keel_proof.h"
#include "../common/priority_contracts.h"

void keel_priority_promotion_age_us__exact_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint32_t period_us = any_bits(12u) + 1u;
    const uint64_t limit = 15u * (uint64_t)period_us;
    uint64_t age_us;

    __CPROVER_assume(keel_priority_promotion_age_us_may(sp, period_us));
    age_us = keel_priority_promotion_age_us(sp, period_us);

    __CPROVER_assert(keel_priority_promotion_age_us_does(age_us, sp, period_us),
                     "PRI_004_part: as the decision takes it to do");
    __CPROVER_assert((0u < age_us) && (age_us < 0x800000000u), "PRI_004_range: 0 < age < 2^35");
    __CPROVER_assert((sp * age_us) >= limit, "PRI_004_promoted: at this age eq. 3 saturates");
    __CPROVER_assert((sp * (age_us - 1u)) < limit,
                     "PRI_004_not_before: one microsecond earlier it does not");
}
