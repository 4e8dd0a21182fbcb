// cbmc: --unwind 2 --external-sat-solver cadical
// sources: src/rtos/priority.c
// covers: keel_priority_promoted saturation
#include "../common/keel_proof.h"

void keel_priority_promoted_harness(void)
{
    const uint32_t sp = any_bits(4u) + 1u;
    const uint64_t age_us = nondet_u64();
    const uint32_t period_us = any_period();
    const uint64_t limit = 15u * (uint64_t)period_us;
    bool promoted;

    promoted = keel_priority_promoted(sp, age_us, period_us);

    /* As sp is 1 at least, an age of 15 T suffices; below it the product fits 64 bits. */
    __CPROVER_assert(promoted == ((age_us >= limit) || ((sp * age_us) >= limit)),
                     "PRI_004: promoted exactly when eq. 3 saturates: sp * age >= 15 T");
}
