// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_check is_cutoff_valid is_above
//
// Every bit pattern of a configuration: the status names a field that is wrong.
#include "../common/voter_proof.h"

/* cutoff_valid */
static bool cutoff_valid_here(const keel_voter_config_t *c)
{
    return (1.0f < c->cutoff) && (c->cutoff <= (KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN)) &&
           disagree_valid_here(c->agree, c->cutoff * c->agree);
}

void keel_voter_check__clauses_harness(void)
{
    const keel_voter_config_t config = any_voter_config();
    const keel_status_t status = keel_voter_check(&config);

    __CPROVER_assert((status == KEEL_ERR_SENSORS) ==
                         !((2u <= config.sensors) && (config.sensors <= KEEL_VOTER_SENSORS)),
                     "VOT_001_sensors: just where their number is wrong");
    __CPROVER_assert((status != KEEL_ERR_AGREEMENT) || !agreement_valid_here(&config),
                     "VOT_001_agreement: only where a, or its slope, is wrong");
    __CPROVER_assert((status != KEEL_ERR_CUTOFF) || !cutoff_valid_here(&config),
                     "VOT_001_cutoff: only where n is wrong");
    __CPROVER_assert((status != KEEL_ERR_LIMITS) || !limits_valid_here(&config),
                     "VOT_001_limits: only where the limits are wrong");
    __CPROVER_assert((status != KEEL_ERR_INITIAL) || !initial_valid_here(&config),
                     "VOT_001_initial: only where the first output is wrong");
    __CPROVER_assert((status != KEEL_ERR_AGE) || (config.max_age_us == 0u),
                     "VOT_001_age: only where the age is wrong");
    __CPROVER_assert((status != KEEL_ERR_LATCH) || (config.latch_count == 0u),
                     "VOT_001_latch: only where the count is wrong");
}
