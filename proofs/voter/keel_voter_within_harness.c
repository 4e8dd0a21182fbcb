// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_within
#include "../common/voter_contracts.h"

void keel_voter_within_harness(void)
{
    const float least = nondet_float();
    const float most = nondet_float();
    const float agree = nondet_float();
    bool within;

    __CPROVER_assume(keel_voter_within_may(least, most, agree));

    within = keel_voter_within(least, most, agree);

    __CPROVER_assert(keel_voter_within_does(within, least, most, agree),
                     "VOT_018_within: just when they are at most a apart");
}
