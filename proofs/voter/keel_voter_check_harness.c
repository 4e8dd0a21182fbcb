// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// checks: assertions
// covers: keel_voter_check is_cutoff_valid is_above model_voter_check
//
// Every bit pattern of a configuration. All other checks: keel_voter_check__accepted_harness.c.
#include "../common/voter_proof.h"

void keel_voter_check_harness(void)
{
    const keel_voter_config_t config = any_voter_config();
    const keel_voter_config_t before = config;
    const keel_status_t expected = model_voter_check(&before);

    __CPROVER_assert(keel_voter_check(&config) == expected, "VOT_001_model: as the model says");
    __CPROVER_assert(voter_config_same(&config, &before), "VOT_001_model: nothing changes");
}
