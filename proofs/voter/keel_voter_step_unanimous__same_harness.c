// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --refine
// sources: src/middleware/voter.c
// replaces: keel_voter_mean
// covers: keel_voter_step_unanimous is_unanimous keel_voter_within keel_voter_plain_mean
//
// The shorter way and the whole vote, from the same state with the same samples, come to the same:
// a = 1, two to four sensors, whole samples from -2 to 2 of which those from -1 to 1 are
// plausible. What the mean is of is compared in place of the mean.
#include "../common/any_below.h"
#include "voter_stand_ins.h"

static const float smalls[5] = {-2.0f, -1.0f, 0.0f, 1.0f, 2.0f};

static float any_small(void)
{
    return smalls[any_below(5u)];
}

void keel_voter_step_unanimous__same_harness(void)
{
    keel_voter_t voter;
    keel_voter_t whole;
    keel_voter_sample_t sample[SENSORS];
    float sum;
    float weights;

    any_voter(&voter, 1.0f, 3.0f);
    voter.config.lowest = -1.0f;
    voter.config.highest = 1.0f;
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].value = any_small();
        sample[i].age_us = 0u;
        sample[i].present = true;
        voter.sensor[i].last = any_small();
    }
    __CPROVER_assume(voter_valid_here(&voter));
    whole = voter;
    if (keel_voter_step_unanimous(&voter, sample, 0u)) {
        sum = stand_in_sum;
        weights = stand_in_weights;
        keel_voter_step(&whole, sample, nondet_u32());
        whole.vote.output = voter.vote.output;
        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(voter_same(&whole, &voter, i), "VOT_018_same: in every other field");
        }
        __CPROVER_assert(float_same(stand_in_sum, sum) && float_same(stand_in_weights, weights),
                         "VOT_018_same: the mean is of the same");
    }
}
