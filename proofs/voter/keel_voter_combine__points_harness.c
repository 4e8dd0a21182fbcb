// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --object-bits 10
// sources: src/middleware/voter.c specs/model/voter_parts.c specs/model/range.c
// checks: assertions
// covers: keel_voter_combine model_voter_combine
//
// Chosen samples and weights: zeros of both signs, which rounding to 0 brings to light; values just
// beyond the range; none that counts; the largest first. All: keel_voter_combine_harness.c, where
// z3 finds no example.
#include "../common/voter_proof.h"

#define POINTS 9u

static const float value[POINTS][SENSORS] = {
    {1.0f, 2.5f, -3.0f, 4.0f},
    {0.0f, -0.0f, 0.0f, -0.0f},
    {-0.0f, 0.0f, -0.0f, 0.0f},
    {0.0f, -0.0f, 0x1p-149f, 0.0f},
    {0.0f, -0.0f, -0x1p-149f, 0.0f},
    {1000000.5f, 1000000.5f, 1000000.5f, 1000000.5f},
    {-1000000.5f, -1000000.5f, -1000000.5f, -1000000.5f},
    {1.0f, 2.0f, 3.0f, 4.0f},
    {9.0f, 5.0f, 6.0f, 7.0f},
};

static const float weight[POINTS][SENSORS] = {
    {0.25f, 0.5f, 0.75f, 1.0f}, {1.0f, 1.0f, 0.0f, 0.0f},  {1.0f, 1.0f, 0.0f, 0.0f},
    {1.0f, 1.0f, 0.25f, 0.0f},  {1.0f, 1.0f, 0.25f, 0.0f}, {1.0f, 0.0f, 1.0f, 1.0f},
    {1.0f, 0.0f, 1.0f, 1.0f},   {0.0f, 0.0f, 0.0f, 0.0f},  {1.0f, 0.5f, 0.5f, 0.5f},
};

void keel_voter_combine__points_harness(void)
{
    for (uint32_t point = 0u; point < POINTS; point++) {
        keel_voter_sample_t sample[SENSORS];
        float expected;

        for (uint32_t i = 0u; i < SENSORS; i++) {
            sample[i].value = value[point][i];
            sample[i].age_us = 0u;
            sample[i].present = true;
        }
        expected = model_voter_combine(sample, weight[point], SENSORS);

        __CPROVER_assert(float_same(keel_voter_combine(sample, weight[point], SENSORS), expected),
                         "VOT_005_points: as the model says");
    }
}
