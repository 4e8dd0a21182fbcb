/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter_stand_ins.h
 * @brief What stands in for the voter's parts where a whole vote is proved.
 *
 * Each asserts its part's precondition, and returns the value of a function of all that the part
 * reads, of which nothing is known but the part's postcondition: a harness that `replaces` the part
 * proves what holds of every function with that contract. The part's own harness proves that it is
 * one.
 */
#ifndef VOTER_STAND_INS_H
#define VOTER_STAND_INS_H

#include "../common/voter_contracts.h"

float __CPROVER_uninterpreted_agreement(float x, float y, float agree, float disagree);
float __CPROVER_uninterpreted_weight(float a, float b, float c, uint32_t others);
float __CPROVER_uninterpreted_mean(float sum, float weights, float least, float most);
float __CPROVER_uninterpreted_plain_mean(float x0, float x1, float x2, float x3, uint32_t sensors,
                                         float least, float most);
uint32_t __CPROVER_uninterpreted_within(float least, float most, float agree);
float __CPROVER_uninterpreted_combine(float x0, float x1, float x2, float x3, float w0, float w1,
                                      float w2, float w3, uint32_t sensors);

float keel_voter_agreement_stand_in(float x, float y, float agree, float disagree)
{
    const float s = __CPROVER_uninterpreted_agreement(x, y, agree, disagree);

    __CPROVER_assert(keel_voter_agreement_may(x, y, agree, disagree),
                     "precondition: keel_voter_agreement");
    __CPROVER_assume(keel_voter_agreement_does(s));
    return s;
}

/* Element i of so many, 0 beyond them: what is not read decides nothing. */
static float read(const float of[], uint32_t i, uint32_t count)
{
    return (i < count) ? of[i] : 0.0f;
}

float keel_voter_weight_stand_in(const float agreement[], uint32_t others)
{
    const float w = __CPROVER_uninterpreted_weight(read(agreement, 0u, others),
                                                   read(agreement, 1u, others),
                                                   read(agreement, 2u, others), others);

    __CPROVER_assert(keel_voter_weight_may(agreement, others), "precondition: keel_voter_weight");
    __CPROVER_assume(keel_voter_weight_does(w, agreement, others));
    return w;
}

/* What the quotient was asked of, for harnesses that check eq. 18 in numbers. */
static float stand_in_sum;
static float stand_in_weights;

float keel_voter_mean_stand_in(float sum, float weights, float least, float most)
{
    const float mean = __CPROVER_uninterpreted_mean(sum, weights, least, most);

    stand_in_sum = sum;
    stand_in_weights = weights;
    __CPROVER_assert(keel_voter_mean_may(sum, weights, least, most),
                     "precondition: keel_voter_mean");
    __CPROVER_assume(keel_voter_mean_does(mean, least, most));
    return mean;
}

bool keel_voter_within_stand_in(float least, float most, float agree)
{
    const bool within = __CPROVER_uninterpreted_within(least, most, agree) != 0u;

    __CPROVER_assert(keel_voter_within_may(least, most, agree), "precondition: keel_voter_within");
    __CPROVER_assume(keel_voter_within_does(within, least, most));
    return within;
}

/* The value of sample i of so many, as above. */
static float value_of(const keel_voter_sample_t sample[], uint32_t i, uint32_t sensors)
{
    return ((i < SENSORS) && (i < sensors)) ? sample[i].value : 0.0f;
}

float keel_voter_plain_mean_stand_in(const keel_voter_sample_t sample[], uint32_t sensors,
                                     float least, float most)
{
    const float mean = __CPROVER_uninterpreted_plain_mean(value_of(sample, 0u, sensors),
                                                          value_of(sample, 1u, sensors),
                                                          value_of(sample, 2u, sensors),
                                                          value_of(sample, 3u, sensors), sensors,
                                                          least, most);

    __CPROVER_assert(keel_voter_plain_mean_may(sample, sensors, least, most),
                     "precondition: keel_voter_plain_mean");
    __CPROVER_assume(keel_voter_plain_mean_does(mean, least, most));
    return mean;
}

float keel_voter_combine_stand_in(const keel_voter_sample_t sample[], const float weight[],
                                  uint32_t sensors)
{
    const float mean = __CPROVER_uninterpreted_combine(value_of(sample, 0u, sensors),
                                                       value_of(sample, 1u, sensors),
                                                       value_of(sample, 2u, sensors),
                                                       value_of(sample, 3u, sensors),
                                                       read(weight, 0u, sensors),
                                                       read(weight, 1u, sensors),
                                                       read(weight, 2u, sensors),
                                                       read(weight, 3u, sensors), sensors);

    __CPROVER_assert(keel_voter_combine_may(sample, weight, sensors),
                     "precondition: keel_voter_combine");
    __CPROVER_assume(keel_voter_combine_does(mean, sample, weight, sensors));
    return mean;
}

#endif
