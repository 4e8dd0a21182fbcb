// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_init
#include "../common/voter_contracts.h"

void keel_voter_init__valid_harness(void)
{
    keel_voter_t voter;
    const keel_voter_config_t config = any_voter_config();

    if (keel_voter_init(&voter, &config) == KEEL_OK) {
        __CPROVER_assert(voter_valid_here(&voter), "VOT_002_ready: the channel is valid");
    }
}
