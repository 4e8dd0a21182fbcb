// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5
// sources: src/middleware/voter.c
// defines: -DKEEL_VOTER_SENSORS=3u
// replaces: keel_voter_mean
// covers: keel_voter_step compare_samples weigh_sensors judge_sensors conclude_vote
// covers: keel_voter_agreement keel_voter_weight keel_voter_combine
//
// Eq. 16 to 18 in numbers: a = 1, n = 3, two or three sensors of which each may be absent, samples
// among eight halves from -4 to 2.5. Agreements are then quarters, weights eighths, and all sums
// exact.
#include "voter_stand_ins.h"

/* With all distances up to 7, and three of which each two are 6 or more apart. */
static const uint32_t halves[8] = {0u, 2u, 3u, 5u, 6u, 7u, 12u, 13u};

/* The agreement of two samples, given in halves, in quarters. */
static uint32_t quarters(uint32_t x, uint32_t y)
{
    const uint32_t distance = (x > y) ? (x - y) : (y - x);

    return (distance <= 2u) ? 4u : ((distance >= 6u) ? 0u : (6u - distance));
}

/* Whether one of the other two lies below and one above. */
static bool is_middle(const uint32_t half[SENSORS], uint32_t i)
{
    const uint32_t one = half[(i + 1u) % 3u];
    const uint32_t other = half[(i + 2u) % 3u];

    return ((one < half[i]) && (half[i] < other)) || ((other < half[i]) && (half[i] < one));
}

void keel_voter_step__exact_harness(void)
{
    const bool three = nondet_bool();
    keel_voter_t voter;
    keel_voter_sample_t sample[SENSORS];
    uint32_t half[SENSORS];
    uint32_t eighths[SENSORS] = {0u};
    uint32_t usable = 0u;
    bool nobody;
    int32_t sum = 0;
    uint32_t weights = 0u;

    any_voter(&voter, 1.0f, 3.0f);
    voter.config.sensors = three ? 3u : 2u;
    voter.unanimous = false;
    voter.config.lowest = -5.0f;
    voter.config.highest = 4.0f;
    voter.config.stale_count = 0u;
    for (uint32_t i = 0u; i < SENSORS; i++) {
        half[i] = halves[nondet_u8() & 7u];
        sample[i].value = 0.5f * ((float)half[i] - 8.0f);
        sample[i].age_us = 0u;
        sample[i].present = nondet_bool();
        voter.sensor[i].latched = false;
        usable += ((i < voter.config.sensors) && sample[i].present) ? 1u : 0u;
    }

    __CPROVER_assume(voter_valid_here(&voter));

    keel_voter_step(&voter, sample, 0u);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if ((i < voter.config.sensors) && sample[i].present) {
            for (uint32_t j = 0u; j < SENSORS; j++) {
                if ((j != i) && (j < voter.config.sensors) && sample[j].present) {
                    eighths[i] += quarters(half[i], half[j]) * (three ? 1u : 2u);
                }
            }
            eighths[i] = (usable == 1u) ? 8u : eighths[i];
        }
    }
    nobody = (usable == 3u) && ((eighths[0] + eighths[1] + eighths[2]) == 0u);
    for (uint32_t i = 0u; i < SENSORS; i++) {
        if ((i < voter.config.sensors) && sample[i].present) {
            eighths[i] = (nobody && is_middle(half, i)) ? 8u : eighths[i];
            weights += eighths[i];
            sum += (int32_t)eighths[i] * ((int32_t)half[i] - 8);
            __CPROVER_assert((voter.vote.weight[i] * 8.0f) == (float)eighths[i],
                             "VOT_006_weight: the mean of its agreements");
            __CPROVER_assert(voter.vote.reason[i] ==
                                 ((eighths[i] > 0u) ? KEEL_VOTER_USED : KEEL_VOTER_OUTVOTED),
                             "VOT_006_outvoted: a usable sample without agreement is outvoted");
        }
    }
    if (weights > 0u) {
        __CPROVER_assert((stand_in_sum * 16.0f) == (float)sum, "VOT_005_sum: of eq. 18");
        __CPROVER_assert((stand_in_weights * 8.0f) == (float)weights,
                         "VOT_005_weights: and its weights");
    }
}
