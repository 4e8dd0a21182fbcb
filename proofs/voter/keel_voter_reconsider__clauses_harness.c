// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --external-sat-solver cadical
// checks: assertions
// sources: src/middleware/voter.c
// replaces: keel_voter_within
// covers: keel_voter_reconsider
//
// As keel_voter_reconsider_harness.c, every valid channel of 2 to 4 sensors after a vote, every bit
// pattern of the samples: the contract, clause by clause.
#include "voter_stand_ins.h"

static keel_voter_t old;
static keel_voter_t now;
static keel_voter_sample_t sample[SENSORS];

static void check_healthy(uint32_t i)
{
    const keel_voter_sensor_t *const before = &old.sensor[i];
    const keel_voter_sensor_t *const after = &now.sensor[i];

    __CPROVER_assert(before->latched || (!after->latched && (after->last == before->last) &&
                                         (after->unchanged_votes == before->unchanged_votes) &&
                                         (after->condemned_votes == before->condemned_votes) &&
                                         (after->density == before->density) &&
                                         (after->probation == before->probation)),
                     "VOT_021_healthy: one that is not latched stays as it is");
}

static void check_readmitted(uint32_t i)
{
    const keel_voter_sensor_t *const after = &now.sensor[i];
    const uint32_t enough = now.config.readmit_count;
    const float value = sample[i].value;
    const bool readmitted = old.sensor[i].latched && !after->latched;

    __CPROVER_assert(!readmitted ||
                         ((0u < enough) && (enough <= (old.sensor[i].probation + 1u)) &&
                          sample[i].present && finite_here(value) && (now.config.lowest <= value) &&
                          (value <= now.config.highest) &&
                          (sample[i].age_us <= now.config.max_age_us) &&
                          (after->condemned_votes == 0u) && (after->density == 0u) &&
                          (after->probation == 0u)),
                     "VOT_021_readmitted: after enough good votes, with nothing counted");
}

void keel_voter_reconsider__clauses_harness(void)
{
    any_voter(&now, nondet_float(), nondet_float());
    __CPROVER_assume(keel_voter_reconsider_may(&now));
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].value = nondet_float();
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
    }
    old = now;

    keel_voter_reconsider(&now, sample);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        check_healthy(i);
        if (i < now.config.sensors) {
            check_readmitted(i);
        }
    }
}
