// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_plain_mean keel_voter_within
// covers: keel_voter_step_unanimous
//
// A vote that was taken and the whole vote from the same state, with the same samples, come to the
// same in every field but the output: every valid channel of two to four sensors, every bit pattern
// of the values. It rests on what specs/soundness.md argues: that samples within a agree fully.
#include "voter_parts.h"

/* All samples agree fully, and so have the weight 1. */
static void all_agree(const keel_voter_t *voter, const keel_voter_sample_t sample[SENSORS])
{
    const float ones[SENSORS - 1u] = {1.0f, 1.0f, 1.0f};

    for (uint32_t j = 1u; j < SENSORS; j++) {
        for (uint32_t i = 0u; i < j; i++) {
            __CPROVER_assume((j >= voter->config.sensors) ||
                             (model_voter_agreement(sample[i].value, sample[j].value, voter->agree,
                                                    voter->disagree) == 1.0f));
        }
    }
    for (uint32_t others = 1u; others < SENSORS; others++) {
        __CPROVER_assert(keel_voter_weight(ones, others) == 1.0f,
                         "VOT_018_ones: full agreement with all others is the weight 1");
    }
    __CPROVER_assume(model_voter_weight(ones, voter->config.sensors - 1u) == 1.0f);
}

void keel_voter_step_unanimous__whole_harness(void)
{
    const uint32_t oldest_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t whole;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];

    any_voter(&voter, nondet_float(), nondet_float());
    any_samples(sample, before);
    __CPROVER_assume(keel_voter_step_unanimous_may(&voter, sample, oldest_us));
    whole = voter;
    if (keel_voter_step_unanimous(&voter, sample, oldest_us)) {
        all_agree(&whole, before);
        model_voter_step(&whole, before, nondet_u32());
        whole.vote.output = voter.vote.output;
        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(voter_same(&voter, &whole, i), "VOT_018_whole: in every other field");
        }
    }
}
