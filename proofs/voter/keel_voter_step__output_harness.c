// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=3u
// covers: keel_voter_step keel_voter_combine keel_voter_weight conclude find_outvoted
//
// The output. Bounded to two or three sensors, a = 1, n = 3, and samples from a few that stand for
// all cases (voter_proof.h). The harnesses of agreement, weight and mean have no such bounds.
#include "../common/voter_proof.h"

void keel_voter_step__output_harness(void)
{
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    const uint32_t elapsed_us = nondet_u32();
    bool above = false;
    bool below = false;
    uint32_t usable = 0u;
    bool held;

    any_voter(&voter, 1.0f, 3.0f);
    any_samples(sample);
    narrow_voter(&voter, sample);
    before = voter;

    keel_voter_step(&voter, sample, elapsed_us);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        const uint8_t reason = voter.vote.reason[i];

        if (i < voter.config.sensors) {
            usable += (reason <= KEEL_VOTER_OUTVOTED) ? 1u : 0u;
            if (reason == KEEL_VOTER_USED) {
                above = above || (sample[i].value <= voter.vote.output);
                below = below || (voter.vote.output <= sample[i].value);
                __CPROVER_assert((voter.vote.state != KEEL_VOTER_SINGLE) ||
                                     (voter.vote.output == sample[i].value),
                                 "VOT_009_single: the only usable sample is the output");
            }
            __CPROVER_assert((voter.vote.weight[i] > 0.0f) == (reason == KEEL_VOTER_USED),
                             "VOT_006_reason: a weight of 0 has a reason, another has none");
        }
    }
    held = voter.vote.state >= KEEL_VOTER_DISAGREE;
    __CPROVER_assert(finite_here(voter.vote.output) && (voter.config.lowest <= voter.vote.output) &&
                         (voter.vote.output <= voter.config.highest),
                     "VOT_005_valid: the output is finite and plausible");
    __CPROVER_assert(held || (above && below),
                     "VOT_005_hull: it lies among the samples that contributed");
    __CPROVER_assert((voter.vote.state == KEEL_VOTER_NONE) == (usable == 0u),
                     "VOT_008_none: held when nothing is usable");
    __CPROVER_assert((voter.vote.state == KEEL_VOTER_SINGLE) == (usable == 1u),
                     "VOT_009_state: one usable sample");
    __CPROVER_assert(!held || (voter.vote.output == before.vote.output),
                     "VOT_008_hold: the output is held");
    __CPROVER_assert(voter.vote.held == (!held                             ? 0u
                                         : (before.vote.held < UINT32_MAX) ? (before.vote.held + 1u)
                                                                           : UINT32_MAX),
                     "VOT_008_held: votes without an output are counted");
    __CPROVER_assert(held || (voter.vote.held_us == 0u), "VOT_008_held_us: nothing held");
    __CPROVER_assert(!held || (voter.vote.held_us >= before.vote.held_us),
                     "VOT_008_held_us: the time only grows");
    __CPROVER_assert(!held || (voter.vote.held_us == UINT32_MAX) ||
                         ((voter.vote.held_us - before.vote.held_us) == elapsed_us),
                     "VOT_008_held_us: by what has elapsed");
}
