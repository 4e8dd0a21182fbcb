// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// checks: assertions
// sources: src/middleware/voter.c
// replaces: keel_voter_within
// covers: keel_voter_reconsider
//
// As keel_voter_reconsider_harness.c, every valid channel of 2 to 4 sensors after a vote, every bit
// pattern of the samples: what is readmitted agrees. A sensor is drawn, and of its sample alone it
// is known that "within a" is the rounded difference, as keel_voter_within_harness.c proves.
#include "../common/any_below.h"
#include "voter_stand_ins.h"

/* The clause, with what VOT_018_within says of the two: each difference there is the clause's own,
 * or its negative. */
static void check_distance(float value, float output, float agree)
{
    if (value < output) {
        __CPROVER_assume((__CPROVER_uninterpreted_within(value, output, agree) != 0u) ==
                         ((output - value) <= agree));
    } else {
        __CPROVER_assume((__CPROVER_uninterpreted_within(output, value, agree) != 0u) ==
                         ((value - output) <= agree));
    }
    __CPROVER_assert((-agree <= (value - output)) && ((value - output) <= agree),
                     "VOT_021_agrees: where there is an output, within a of it");
}

void keel_voter_reconsider__agrees_harness(void)
{
    const uint32_t i = any_below(SENSORS);
    keel_voter_t voter;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t copy[SENSORS];
    bool latched;

    any_voter(&voter, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_reconsider_may(&voter));
    any_samples(sample, copy);
    latched = voter.sensor[i].latched;

    keel_voter_reconsider(&voter, sample);

    if ((i < voter.config.sensors) && latched && !voter.sensor[i].latched &&
        (voter.vote.contributing > 0u)) {
        check_distance(sample[i].value, voter.vote.output, voter.agree);
    }
}
