// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// sources: src/rtos/priority.c specs/model/priority.c
// covers: keel_priority_promotion_age_us saturation model_priority_promotion_age_us saturation_us
//
// For all periods and priorities. That eq. 3 saturates at this age, and not before, is in
// keel_priority_promotion_age_us__exact_harness.
#include "../../specs/model/priority.h"
#include "../common/keel_proof.h"

void keel_priority_promotion_age_us_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint32_t period_us = any_period();
    const uint64_t age_us = keel_priority_promotion_age_us(sp, period_us);

    __CPROVER_assert(age_us == model_priority_promotion_age_us(sp, period_us),
                     "PRI_004_model: (max - 1) * T / sp, rounded up");
}
