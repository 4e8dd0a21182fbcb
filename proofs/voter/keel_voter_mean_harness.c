// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_mean model_voter_mean
//
// Every bit pattern. All other checks: keel_voter_mean__bounds_harness.c, for what callers may ask.
#include "../common/voter_proof.h"

void keel_voter_mean_harness(void)
{
    const float sum = nondet_float();
    const float weights = nondet_float();
    const float least = nondet_float();
    const float most = nondet_float();
    const float expected = model_voter_mean(sum, weights, least, most);

    __CPROVER_assert(float_same(keel_voter_mean(sum, weights, least, most), expected),
                     "VOT_005_model: as the model says");
}
