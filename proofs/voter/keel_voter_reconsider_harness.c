// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_within
// covers: keel_voter_reconsider speaks_for inspect_sample is_stale one_more
// covers: model_voter_reconsider
//
// Every valid channel of 2 to 4 sensors after a vote, every bit pattern of the samples. "Within a"
// is any function of its arguments with its contract, the same for the model (voter_parts.h).
#include "voter_parts.h"

void keel_voter_reconsider_harness(void)
{
    keel_voter_t voter;
    keel_voter_t model;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];

    any_voter(&voter, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_reconsider_may(&voter));
    any_samples(sample, before);
    model = voter;
    model_voter_reconsider(&model, before);

    keel_voter_reconsider(&voter, sample);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i), "VOT_021_model: as the model says");
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_sample_same(&sample[i], &before[i]),
                         "VOT_021_read: the samples are only read");
    }
    __CPROVER_assert(keel_voter_reconsider_does(&voter), "VOT_021_valid: the channel stays valid");
}
