// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 14 --object-bits 10
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// covers: keel_voter_init keel_voter_check model_voter_init model_voter_check
//
// Chosen configurations: one within all limits, one at them, and one beyond each of them, of which
// none may change the channel. All: keel_voter_init_harness.c, where z3 finds no example.
#include "../common/voter_proof.h"

#define POINTS 12u

/* With voter_config_t's fields in their order. */
static const keel_voter_config_t given[POINTS] = {
    {1.0f, 3.0f, 0.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {KEEL_VOTER_AGREE_MAX, 1000.0f, 1.0f, -KEEL_VOTER_RANGE, KEEL_VOTER_RANGE, KEEL_VOTER_RANGE, 1u,
     1u, 0u, 0u, 0u, 4u},
    {1.0f, 3.0f, 0.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 1u},
    {0.0f, 3.0f, 0.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, -0.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 1.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 1.0f, 0.5f, -100.0f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 0.5f, 100.0f, -100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 0.5f, -1000000.5f, 100.0f, 1.5f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 0.5f, -100.0f, 100.0f, 101.0f, 1000u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 0.5f, -100.0f, 100.0f, 1.5f, 0u, 2u, 7u, 6u, 9u, 3u},
    {1.0f, 3.0f, 0.5f, -100.0f, 100.0f, 1.5f, 1000u, 0u, 7u, 6u, 9u, 3u},
};

/* Every field is another than init gives it. */
static keel_voter_t voted(void)
{
    keel_voter_t voter = {.agree = 0.5f, .disagree = 5.0f, .unanimous = true};

    voter.vote.output = 6.0f;
    voter.vote.held = 7u;
    voter.vote.held_us = 8u;
    voter.vote.state = KEEL_VOTER_MEAN;
    voter.vote.contributing = 2u;
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter.sensor[i].last = 1.0f;
        voter.sensor[i].unchanged_votes = 2u;
        voter.sensor[i].probation = 6u;
        voter.sensor[i].condemned_votes = 3u;
        voter.sensor[i].density = 4u;
        voter.sensor[i].latched = true;
        voter.vote.weight[i] = 0.5f;
        voter.vote.reason[i] = KEEL_VOTER_LATCHED;
    }
    return voter;
}

void keel_voter_init__points_harness(void)
{
    for (uint32_t i = 0u; i < POINTS; i++) {
        keel_voter_t voter = voted();
        keel_voter_t model = voter;
        const keel_status_t expected = model_voter_init(&model, &given[i]);

        __CPROVER_assert(keel_voter_init(&voter, &given[i]) == expected,
                         "VOT_002_points: taken or refused as the model says");
        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(voter_same(&voter, &model, i),
                             "VOT_002_points: every field is what the model says");
        }
    }
}
