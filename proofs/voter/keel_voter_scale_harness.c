// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --z3 --fpa
// checks: assertions
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// covers: keel_voter_scale is_above model_voter_scale
//
// Any channel at all: the same thresholds as the model's, bit for bit. All other checks:
// keel_voter_scale__valid_harness.c.
#include "../common/voter_proof.h"

void keel_voter_scale_harness(void)
{
    keel_voter_t voter;
    keel_voter_t model;

    any_voter(&voter, nondet_float(), nondet_float());
    model = voter;
    model_voter_scale(&model);

    keel_voter_scale(&voter);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i), "VOT_019_model: as the model says");
    }
}
