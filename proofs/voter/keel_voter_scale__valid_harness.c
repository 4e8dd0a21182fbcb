// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// covers: keel_voter_scale is_above
//
// Every valid channel: its thresholds are valid, and a does not fall below that of the
// configuration.
#include "voter_stand_ins.h"

void keel_voter_scale__valid_harness(void)
{
    keel_voter_t voter;

    any_voter(&voter, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_scale_may(&voter) && config_valid_here(&voter.config));

    keel_voter_scale(&voter);

    __CPROVER_assert(keel_voter_scale_does(&voter), "VOT_019_thresholds: the channel stays valid");
    __CPROVER_assert(voter.config.agree <= voter.agree, "VOT_019_thresholds: a is not less");
    __CPROVER_assert((voter.config.slope != 0.0f) || (voter.agree == voter.config.agree),
                     "VOT_019_constant: without a slope a is constant");
}
