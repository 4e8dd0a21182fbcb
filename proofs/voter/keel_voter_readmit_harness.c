// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// covers: keel_voter_readmit model_voter_readmit
#include "voter_stand_ins.h"

void keel_voter_readmit_harness(void)
{
    keel_voter_t voter;
    keel_voter_t model;
    const uint32_t sensor = nondet_u32();
    keel_status_t expected;
    keel_status_t status;

    any_voter(&voter, nondet_float(), nondet_float());
    __CPROVER_assume(voter_valid_here(&voter));
    model = voter;
    expected = model_voter_readmit(&model, sensor);

    status = keel_voter_readmit(&voter, sensor);

    __CPROVER_assert(status == expected, "VOT_014_model: as the model says");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i), "VOT_014_model: in every field");
    }
    __CPROVER_assert(voter_valid_here(&voter), "VOT_014_valid: the channel stays valid");
}
