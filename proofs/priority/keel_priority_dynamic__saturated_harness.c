// cbmc: --unwind 2 --external-sat-solver cadical
// sources: src/rtos/priority.c
// covers: keel_priority_dynamic keel_priority_promoted saturation quotient
//
// For all ages, periods and priorities: dp is the maximum once sp * age reaches 15 T.
#include "../common/keel_proof.h"

void keel_priority_dynamic__saturated_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint64_t age_us = nondet_u64();
    const uint32_t period_us = any_period();
    const uint64_t limit = 15u * (uint64_t)period_us;
    const uint32_t dp = keel_priority_dynamic(sp, age_us, period_us);

    __CPROVER_assert(dp >= 1u, "PRI_002: dp is 1 at least");
    if ((age_us >= limit) || ((sp * age_us) >= limit)) {
        __CPROVER_assert(dp == KEEL_PRIORITY_REALTIME,
                         "PRI_001_saturated: dp is the maximum once sp * age reaches 15 T");
    }
}
