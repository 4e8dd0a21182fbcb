// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// checks: assertions
// covers: keel_voter_init model_voter_init
//
// Every bit pattern of a configuration, and of what the channel was before. All other checks:
// keel_voter_init__valid_harness.c.
#include "../common/voter_proof.h"

void keel_voter_init_harness(void)
{
    keel_voter_t voter;
    keel_voter_t model;
    const keel_voter_config_t config = any_voter_config();
    const keel_voter_config_t before = config;
    keel_status_t expected;
    keel_status_t status;

    any_voter(&voter, nondet_float(), nondet_float());
    model = voter;
    expected = model_voter_init(&model, &before);

    status = keel_voter_init(&voter, &config);

    __CPROVER_assert(status == expected, "VOT_002_model: as the model says");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i), "VOT_002_model: in every field");
    }
    __CPROVER_assert(voter_config_same(&config, &before), "VOT_002_model: a copy is kept");
}
