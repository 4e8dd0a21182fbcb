// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_mean keel_voter_within
// covers: keel_voter_step_unanimous is_at_rest
//
// Every valid channel of 2 to 4 sensors, every bit pattern of the samples' values and of their
// oldest age. The mean, and what is within a, are as their contracts allow (voter_stand_ins.h).
#include "voter_unanimous.h"

void keel_voter_step_unanimous_harness(void)
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
    __CPROVER_assume(keel_voter_step_unanimous_may(&voter, sample, oldest_us));
    before = voter;
    facts = facts_of(&before, sample);

    taken = keel_voter_step_unanimous(&voter, sample, oldest_us);

    check_attempt(taken, &voter, &before, &facts, sample, oldest_us);
    __CPROVER_assert(samples_same(sample, copy), "VOT_018_read: the samples are only read");
    __CPROVER_assert(keel_voter_step_unanimous_does(&voter),
                     "VOT_018_valid: the channel stays valid");
}
