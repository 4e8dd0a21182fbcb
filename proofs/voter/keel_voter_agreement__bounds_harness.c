// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_agreement
//
// Every a and n a that a configuration may give, every two samples in range.
#include "../common/voter_contracts.h"

void keel_voter_agreement__bounds_harness(void)
{
    const float agree = nondet_float();
    const float disagree = nondet_float();
    const float x = nondet_float();
    const float y = nondet_float();
    float distance;
    float s;

    __CPROVER_assume(keel_voter_agreement_may(x, y, agree, disagree));

    distance = x - y;
    s = keel_voter_agreement(x, y, agree, disagree);

    if ((-agree <= distance) && (distance <= agree)) {
        __CPROVER_assert(s == 1.0f, "VOT_003_full: 1 up to a");
    } else if ((distance <= -disagree) || (disagree <= distance)) {
        __CPROVER_assert(s == 0.0f, "VOT_003_none: 0 from n a on");
    } else {
        __CPROVER_assert(s > 0.0f, "VOT_003_some: not 0 before n a");
    }
}
