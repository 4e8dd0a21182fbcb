// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// replaces: keel_voter_agreement keel_voter_weight keel_voter_combine
// covers: keel_voter_step inspect_sample inspect_samples compare_with_last is_stale compare_samples
// covers: weigh_sensors take_middle judge_sensors conclude_vote clear_sensor condemn_sensor
// covers: one_more add_saturated is_unanimous model_voter_step
//
// A whole vote: every valid channel of 2 to 4 sensors, every bit pattern of the samples. Agreement,
// weight and mean are any functions of their arguments with their contracts, the same for the model
// (voter_parts.h).
#include "voter_parts.h"

/* Whether a sensor of the channel is not latched. */
static bool some_is_not_latched(const keel_voter_t *voter)
{
    bool found = false;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        found = found || ((i < voter->config.sensors) && !voter->sensor[i].latched);
    }
    return found;
}

void keel_voter_step_harness(void)
{
    const uint32_t elapsed_us = nondet_u32();
    keel_voter_t voter;
    keel_voter_t model;
    keel_voter_sample_t sample[SENSORS];
    keel_voter_sample_t before[SENSORS];

    any_voter(&voter, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_step_may(&voter));
    any_samples(sample, before);
    const bool one_stood = some_is_not_latched(&voter);
    model = voter;
    model_voter_step(&model, before, elapsed_us);

    keel_voter_step(&voter, sample, elapsed_us);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_same(&voter, &model, i), "VOT_005_model: as the model says");
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        __CPROVER_assert(voter_sample_same(&sample[i], &before[i]),
                         "VOT_005_read: the samples are only read");
    }
    __CPROVER_assert(keel_voter_step_does(&voter), "VOT_005_valid: the channel stays valid");
    __CPROVER_assert(!one_stood || some_is_not_latched(&voter),
                     "VOT_022_one_stays: of those not latched");
}
