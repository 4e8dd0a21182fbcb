// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_agreement model_voter_agreement
//
// Every bit pattern. All other checks: keel_voter_agreement__bounds_harness.c, for what callers may
// ask.
#include "../common/voter_proof.h"

void keel_voter_agreement_harness(void)
{
    const float x = nondet_float();
    const float y = nondet_float();
    const float agree = nondet_float();
    const float disagree = nondet_float();
    const float expected = model_voter_agreement(x, y, agree, disagree);

    __CPROVER_assert(float_same(keel_voter_agreement(x, y, agree, disagree), expected),
                     "VOT_003_model: as the model says");
}
