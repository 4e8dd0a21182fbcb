// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 6
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_mean model_voter_mean
//
// Chosen quotients: one that is no number, one that is rounded, one on each side of the limits.
// All: keel_voter_mean_harness.c, where z3 finds no example.
#include "../common/voter_proof.h"

#define POINTS 4u

static const struct {
    float sum;
    float weights;
    float least;
    float most;
} given[POINTS] = {
    {0.0f, 0.0f, 1.0f, 2.0f},
    {5.0f, 3.0f, 1.0f, 2.0f},
    {9.0f, 3.0f, 1.0f, 2.0f},
    {1.0f, 3.0f, 1.0f, 2.0f},
};

void keel_voter_mean__points_harness(void)
{
    for (uint32_t i = 0u; i < POINTS; i++) {
        const float expected = model_voter_mean(given[i].sum, given[i].weights, given[i].least,
                                                given[i].most);

        __CPROVER_assert(float_same(keel_voter_mean(given[i].sum, given[i].weights, given[i].least,
                                                    given[i].most),
                                    expected),
                         "VOT_005_points: as the model says");
    }
}
