// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_agreement keel_voter_weight keel_voter_mean keel_voter_combine
// defines: -DKEEL_VOTER_SENSORS=3u
// covers: keel_voter_step inspect inspect_all exclude_stale compare_all judge conclude clear
// covers: condemn one_more add_saturated is_unanimous
//
// A whole vote of two sensors, in three slots: what keel_voter_step__any_harness.c proves for two
// to four, once more for these, in a few seconds. Most faults show here.
#include "../common/voter_stand_ins.h"
#include "../common/voter_vote.h"

void keel_voter_step__a_pair_harness(void)
{
    const float agree = nondet_float();
    const float none = nondet_float();
    const uint32_t elapsed_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    facts_t facts;

    __CPROVER_assume(none_valid_here(agree, none));
    any_voter(&voter, agree, none);
    __CPROVER_assume(voter.config.sensors == 2u);
    any_samples(sample);
    before = voter;
    facts = facts_of(&before, sample);

    keel_voter_step(&voter, sample, elapsed_us);

    check_vote(&voter, &before, &facts, sample, elapsed_us);
}
