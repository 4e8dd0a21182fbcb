// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// sources: src/rtos/priority.c specs/model/priority.c
// covers: keel_priority_dynamic keel_priority_promoted saturation quotient
// covers: model_priority_dynamic model_priority_promoted saturation_us
//
// For all ages, periods and priorities. That the quotient is eq. 3's is in
// keel_priority_dynamic__exact_harness, without a division.
#include "../../specs/model/priority.h"
#include "../common/keel_proof.h"

void keel_priority_dynamic_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint64_t age_us = nondet_u64();
    const uint32_t period_us = any_period();
    const uint32_t dp = keel_priority_dynamic(sp, age_us, period_us);

    __CPROVER_assert(dp == model_priority_dynamic(sp, age_us, period_us),
                     "PRI_001_model: eq. 3, rounded down and saturated");
}
