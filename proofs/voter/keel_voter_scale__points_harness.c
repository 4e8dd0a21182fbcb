// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 5 --object-bits 10
// sources: src/middleware/voter.c specs/model/voter.c specs/model/range.c
// checks: assertions
// covers: keel_voter_scale is_above model_voter_scale
//
// Chosen thresholds, slopes and outputs: a that grows with the output, on either side of 0; one at
// its limit, where n a is within the range and beyond it. All: keel_voter_scale_harness.c, where z3
// finds no example.
#include "../common/voter_proof.h"

#define POINTS 4u

typedef struct point {
    float agree;
    float cutoff;
    float slope;
    float output;
} point_t;

static const point_t given[POINTS] = {
    {2.0f, 3.0f, 0.5f, 10.0f},
    {2.0f, 3.0f, 0.5f, -10.0f},
    {0.5f, 4.0f, 1.0f, KEEL_VOTER_RANGE},
    {0.5f, 4000.0f, 1.0f, -KEEL_VOTER_RANGE},
};

void keel_voter_scale__points_harness(void)
{
    for (uint32_t p = 0u; p < POINTS; p++) {
        keel_voter_t voter = {.agree = 7.0f, .disagree = 8.0f};
        keel_voter_t model;

        voter.config.agree = given[p].agree;
        voter.config.cutoff = given[p].cutoff;
        voter.config.slope = given[p].slope;
        voter.vote.output = given[p].output;
        model = voter;
        model_voter_scale(&model);

        keel_voter_scale(&voter);

        for (uint32_t i = 0u; i < SENSORS; i++) {
            __CPROVER_assert(voter_same(&voter, &model, i), "VOT_019_points: as the model says");
        }
    }
}
