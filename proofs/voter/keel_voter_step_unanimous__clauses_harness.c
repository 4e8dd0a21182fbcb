// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5
// checks: assertions
// sources: src/middleware/voter.c
// replaces: keel_voter_plain_mean keel_voter_within
// covers: keel_voter_step_unanimous
//
// As keel_voter_step_unanimous_harness.c, every valid channel of 2 to 4 sensors, every bit pattern
// of the samples' values and of their oldest age: what a vote that is taken leaves, clause by
// clause, and that one that is refused changes nothing.
#include "voter_stand_ins.h"

void keel_voter_step_unanimous__clauses_harness(void)
{
    const uint32_t oldest_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t before;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t copy[SENSORS];
    bool above = false;
    bool below = false;
    bool taken;

    any_voter(&voter, nondet_float(), nondet_float());
    any_samples(sample, copy);
    __CPROVER_assume(keel_voter_step_unanimous_may(&voter, sample, oldest_us));
    before = voter;

    taken = keel_voter_step_unanimous(&voter, sample, oldest_us);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        const bool votes = i < voter.config.sensors;

        above = above || (votes && (sample[i].value <= voter.vote.output));
        below = below || (votes && (voter.vote.output <= sample[i].value));
        __CPROVER_assert(!taken || !votes || (voter.sensor[i].last == sample[i].value),
                         "VOT_018_last: a vote that is taken keeps its samples");
        __CPROVER_assert(taken || (voter.sensor[i].last == before.sensor[i].last),
                         "VOT_018_refused: one that is not keeps none");
    }
    __CPROVER_assert(!taken || (above && below), "VOT_018_hull: its output lies among them");
    __CPROVER_assert(taken || (voter.vote.output == before.vote.output),
                     "VOT_018_refused: nor another output");
}
