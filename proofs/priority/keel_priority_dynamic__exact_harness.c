// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 17 --external-sat-solver cadical
// sources: src/rtos/priority.c
// covers: keel_priority_dynamic keel_priority_promoted saturation
//
// Every clause of eq. 3, stated by its remainder: dp - 1 periods fit into sp * age, dp periods do
// not. That is exact, and monotone in the age as it stands. Bounded to ages below 2^12 us and
// periods up to 2^8 us, where the solver comes to the end of the division; the
// harness of equality with the model has no such bound, nor has the contract under WP.
#include "../common/keel_proof.h"
#include "../common/priority_contracts.h"

void keel_priority_dynamic__exact_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint64_t age_us = any_bits64(12u);
    const uint32_t period_us = any_bits(8u) + 1u;
    const uint64_t scaled = sp * age_us;
    uint32_t dp;

    __CPROVER_assume(keel_priority_dynamic_may(sp, age_us, period_us));
    dp = keel_priority_dynamic(sp, age_us, period_us);

    __CPROVER_assert(keel_priority_dynamic_does(dp, sp, age_us, period_us),
                     "PRI_001_part: as the decision takes it to do");
    __CPROVER_assert((1u <= dp) && (dp <= KEEL_PRIORITY_REALTIME),
                     "PRI_002: dp lies within its scale");
    __CPROVER_assert((dp == KEEL_PRIORITY_REALTIME) == (scaled >= (15u * (uint64_t)period_us)),
                     "PRI_001_saturated: dp is the maximum exactly when sp * age >= 15 T");
    if (dp < KEEL_PRIORITY_REALTIME) {
        __CPROVER_assert(((dp - 1u) * period_us) <= scaled,
                         "PRI_001_quotient: dp - 1 is at most sp * age / T");
        __CPROVER_assert(scaled < (dp * period_us),
                         "PRI_001_quotient: dp - 1 is at least sp * age / T, rounded down");
    }
}
