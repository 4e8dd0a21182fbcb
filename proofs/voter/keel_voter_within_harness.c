// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// covers: keel_voter_within model_voter_within
#include "../common/voter_contracts.h"

void keel_voter_within_harness(void)
{
    const float least = nondet_float();
    const float most = nondet_float();
    const float agree = nondet_float();
    bool within;

    __CPROVER_assume(keel_voter_within_may(least, most, agree));

    within = keel_voter_within(least, most, agree);

    __CPROVER_assert(within == model_voter_within(least, most, agree),
                     "VOT_018_within: as the model says");
    __CPROVER_assert(keel_voter_within_does(within, least, most),
                     "VOT_018_within: what is equal is within a");
}
