// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_mean keel_voter_within
// defines: -DKEEL_VOTER_SENSORS=2u
// covers: keel_voter_step_unanimous is_at_rest
//
// Two sensors: what keel_voter_step_unanimous_harness.c proves for two to four, once more for
// these, in a few seconds. Most faults show here.
#include "voter_unanimous.h"

void keel_voter_step_unanimous__a_pair_harness(void)
{
    const float agree = nondet_float();
    const float disagree = nondet_float();
    const uint32_t oldest_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t copy[SENSORS];
    facts_t facts;
    bool taken;

    any_voter(&voter, agree, disagree);
    any_samples(sample, copy);
    __CPROVER_assume(voter_valid_here(&voter));
    before = voter;
    facts = facts_of(&before, sample);

    taken = keel_voter_step_unanimous(&voter, sample, oldest_us);

    check_attempt(taken, &voter, &before, &facts, sample, oldest_us);
    __CPROVER_assert(samples_same(sample, copy), "VOT_018_read: the samples are only read");
}
