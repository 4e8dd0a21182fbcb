// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_init
//
// Every bit pattern of a configuration, and of what the channel was before.
#include "../common/voter_contracts.h"

void keel_voter_init__clauses_harness(void)
{
    keel_voter_t voter;
    const keel_voter_config_t config = any_voter_config();
    const bool valid = config_valid_here(&config);
    keel_status_t status;

    any_voter(&voter, nondet_float(), nondet_float());

    status = keel_voter_init(&voter, &config);

    __CPROVER_assert(valid || (status != KEEL_OK),
                     "VOT_002_refused: a configuration that is not valid is refused");
    __CPROVER_assert(!valid || (voter.vote.output == config.initial),
                     "VOT_002_output: the first output is that of the configuration");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(!valid ||
                             (!voter.sensor[i].latched && (voter.sensor[i].condemned_votes == 0u) &&
                              (voter.sensor[i].density == 0u) &&
                              (voter.sensor[i].unchanged_votes == 0u) &&
                              (voter.sensor[i].probation == 0u)),
                         "VOT_002_fresh: nothing is counted against any sensor");
    }
}
