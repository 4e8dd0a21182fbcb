// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// covers: keel_voter_agreement
//
// Every a and n a that a configuration may give, every two samples in range. Those between ends that
// are within a agree fully: keel_voter_step_unanimous rests on it.
#include "../common/voter_contracts.h"

void keel_voter_agreement__bounds_harness(void)
{
    const float agree = nondet_float();
    const float none = nondet_float();
    const float x = nondet_float();
    const float y = nondet_float();
    float s;

    hull.least = nondet_float();
    hull.most = nondet_float();
    hull.agree = nondet_float();
    __CPROVER_assume(keel_voter_within_may(hull.least, hull.most, hull.agree));
    hull.within = model_voter_within(hull.least, hull.most, hull.agree);
    __CPROVER_assume(keel_voter_agreement_may(x, y, agree, none));

    s = keel_voter_agreement(x, y, agree, none);

    __CPROVER_assert((s >= 0.0f) && (s <= 1.0f), "VOT_004: an agreement lies in [0, 1]");
    __CPROVER_assert(keel_voter_agreement_does(s, x, y, agree),
                     "VOT_003_least: nor is it too small to divide by");
}
