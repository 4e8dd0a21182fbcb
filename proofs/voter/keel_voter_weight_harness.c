// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 4 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_weight model_voter_weight
//
// Every bit pattern of one to three agreements. All other checks:
// keel_voter_weight__bounds_harness.c, for what callers may ask.
#include "../common/voter_proof.h"

void keel_voter_weight_harness(void)
{
    const float agreement[SENSORS - 1u] = {nondet_float(), nondet_float(), nondet_float()};

    for (uint32_t others = 1u; others < SENSORS; others++) {
        const float expected = model_voter_weight(agreement, others);

        __CPROVER_assert(float_same(keel_voter_weight(agreement, others), expected),
                         "VOT_006_model: as the model says");
    }
}
