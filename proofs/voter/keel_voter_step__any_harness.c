// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// replaces: keel_voter_agreement keel_voter_weight keel_voter_mean keel_voter_combine
// covers: keel_voter_step inspect inspect_all exclude_stale compare_all judge conclude clear
// covers: condemn one_more add_saturated is_unanimous
//
// A whole vote: every valid channel of 2 to 4 sensors, every bit pattern of the samples. Agreement,
// weight and mean are whatever their contracts allow (voter_stand_ins.h).
#include "../common/voter_stand_ins.h"
#include "../common/voter_vote.h"

void keel_voter_step__any_harness(void)
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
    any_samples(sample);
    __CPROVER_assume(keel_voter_step_may(&voter));
    before = voter;
    facts = facts_of(&before, sample);

    keel_voter_step(&voter, sample, elapsed_us);

    check_vote(&voter, &before, &facts, sample, elapsed_us);
    __CPROVER_assert(keel_voter_step_does(&voter), "VOT_005_valid: the channel stays valid");
}
