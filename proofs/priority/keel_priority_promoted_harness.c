// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// sources: src/rtos/priority.c specs/model/priority.c
// covers: keel_priority_promoted saturation model_priority_promoted saturation_us
//
// For all ages and periods; four bits and 1 are all priorities, 1 to 16.
#include "../../specs/model/priority.h"
#include "../common/keel_proof.h"

void keel_priority_promoted_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint64_t age_us = nondet_u64();
    const uint32_t period_us = any_period();
    const bool promoted = keel_priority_promoted(sp, age_us, period_us);

    __CPROVER_assert(promoted == model_priority_promoted(sp, age_us, period_us),
                     "PRI_004_model: promoted exactly when eq. 3 saturates");
}
