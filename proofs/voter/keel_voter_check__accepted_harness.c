// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_check is_cutoff_valid is_above
#include "../common/voter_proof.h"

void keel_voter_check__accepted_harness(void)
{
    const keel_voter_config_t config = any_voter_config();
    const keel_status_t status = keel_voter_check(&config);

    __CPROVER_assert((status == KEEL_OK) == config_valid_here(&config),
                     "VOT_001_accepted: just the valid configurations are accepted");
}
