// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_mean
#include "../common/voter_contracts.h"

void keel_voter_mean__bounds_harness(void)
{
    const float sum = nondet_float();
    const float weights = nondet_float();
    const float least = nondet_float();
    const float most = nondet_float();
    float mean;

    __CPROVER_assume(keel_voter_mean_may(sum, weights, least, most));

    mean = keel_voter_mean(sum, weights, least, most);

    __CPROVER_assert(keel_voter_mean_does(mean, least, most),
                     "VOT_005_mean: the mean lies among the samples");
}
