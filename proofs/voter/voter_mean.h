/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter_mean.h
 * @brief Eq. 18 for three sensors with each rounding apart.
 *
 * proofs/voter/keel_voter_combine__rounding_harness.c checks that keel_voter_combine computes just
 * this before the clamp; proofs/voter/mean.g bounds what these roundings amount to.
 * One operation per constant: what the names of the roundings in mean.g stand for. An addition to 0
 * is exact and has none.
 */
#ifndef VOTER_MEAN_H
#define VOTER_MEAN_H

static float mean_of_three(float w0, float x0, float w1, float x1, float w2, float x2)
{
    const float p0 = w0 * x0;
    const float s0 = 0.0f + p0;
    const float v0 = 0.0f + w0;
    const float p1 = w1 * x1;
    const float s1 = s0 + p1;
    const float v1 = v0 + w1;
    const float p2 = w2 * x2;
    const float s2 = s1 + p2;
    const float v2 = v1 + w2;
    const float q = s2 / v2;

    return q;
}

#endif
