// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --no-array-field-sensitivity --refine
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_plain_mean keel_voter_within
// covers: keel_voter_step_unanimous model_voter_step_unanimous
//
// Every valid channel of 2 to 4 sensors, every bit pattern of the samples' values and of their
// oldest age. The mean, and what is within a, are any functions of their arguments with their
// contracts, the same for the model (voter_parts.h).
#include "voter_parts.h"

void keel_voter_step_unanimous_harness(void)
{
    const uint32_t oldest_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t model;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];
    bool expected;
    bool taken;

    any_voter(&voter, nondet_float(), nondet_float());
    any_samples(sample, before);
    __CPROVER_assume(keel_voter_step_unanimous_may(&voter, sample, oldest_us));
    model = voter;
    expected = model_voter_step_unanimous(&model, before, oldest_us);

    taken = keel_voter_step_unanimous(&voter, sample, oldest_us);

    __CPROVER_assert(taken == expected, "VOT_018_taken: as the model says");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i),
                         "VOT_018_model: as the model says, in every field");
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_sample_same(&sample[i], &before[i]),
                         "VOT_018_read: the samples are only read");
    }
    __CPROVER_assert(keel_voter_step_unanimous_does(&voter),
                     "VOT_018_valid: the channel stays valid");
}
