// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_agreement
//
// Every a and n a that a configuration may give, every two samples in range, as in
// keel_voter_agreement__bounds_harness.c: asked apart, both are answered in a third of the time.
#include "../common/voter_contracts.h"

void keel_voter_agreement__range_harness(void)
{
    const float agree = nondet_float();
    const float disagree = nondet_float();
    const float x = nondet_float();
    const float y = nondet_float();
    float s;

    __CPROVER_assume(keel_voter_agreement_may(x, y, agree, disagree));

    s = keel_voter_agreement(x, y, agree, disagree);

    __CPROVER_assert((s >= 0.0f) && (s <= 1.0f), "VOT_004: an agreement lies in [0, 1]");
    __CPROVER_assert(keel_voter_agreement_does(s), "VOT_003_least: nor too small to divide by");
}
