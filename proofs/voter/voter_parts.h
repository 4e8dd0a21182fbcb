/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter_parts.h
 * @brief The voter's parts in its model's vote: the same functions as in the code's.
 *
 * A harness of a part proves that the code's is the model's for every float. So what stands in for
 * the one (voter_stand_ins.h) stands in for the other: a harness with this header does not link the
 * model of the parts.
 */
#ifndef VOTER_PARTS_H
#define VOTER_PARTS_H

#include "voter_stand_ins.h"

float model_voter_agreement(float x, float y, float agree, float disagree)
{
    return keel_voter_agreement_stand_in(x, y, agree, disagree);
}

float model_voter_weight(const float agreement[], uint32_t others)
{
    return keel_voter_weight_stand_in(agreement, others);
}

float model_voter_plain_mean(const keel_voter_sample_t sample[], uint32_t sensors, float least,
                             float most)
{
    return keel_voter_plain_mean_stand_in(sample, sensors, least, most);
}

bool model_voter_within(float least, float most, float agree)
{
    return keel_voter_within_stand_in(least, most, agree);
}

float model_voter_combine(const keel_voter_sample_t sample[], const float weight[],
                          uint32_t sensors)
{
    return keel_voter_combine_stand_in(sample, weight, sensors);
}

#endif
