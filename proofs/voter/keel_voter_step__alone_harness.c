// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=2u
// covers: keel_voter_step inspect is_within is_readable
//
// Every bit pattern of a sample, every limit and state; the other sensor gives none.
#include "../common/voter_proof.h"

void keel_voter_step__alone_harness(void)
{
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    uint8_t reason;

    any_voter(&voter, 1.0f, 3.0f);
    any_samples(sample);
    sample[1].present = false;
    sample[1].value = 0.0f;
    before = voter;

    keel_voter_step(&voter, sample, nondet_u32());

    reason = voter.vote.reason[0];
    __CPROVER_assert(reason == reason_of(&voter.config, &before.sensor[0], voter.sensor[0].same,
                                         &sample[0]),
                     "VOT_007_reason: the reason is the first that applies, for every bit pattern");
    __CPROVER_assert((voter.vote.state == KEEL_VOTER_SINGLE) == (reason == KEEL_VOTER_USED),
                     "VOT_009_state: it alone is usable");
    __CPROVER_assert((reason == KEEL_VOTER_USED) || (voter.vote.output == before.vote.output),
                     "VOT_008_hold: else the last output is held");
    __CPROVER_assert(finite_here(voter.vote.output) && (voter.config.lowest <= voter.vote.output) &&
                         (voter.vote.output <= voter.config.highest),
                     "VOT_005_valid: the output is finite and plausible");
}
