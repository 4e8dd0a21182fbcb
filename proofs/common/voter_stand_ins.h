/**
 * @file voter_stand_ins.h
 * @brief What stands in for the voter's parts where a whole vote is proved.
 *
 * Each asserts its part's precondition, and returns anything that the part's postcondition allows:
 * a harness that `replaces` the part proves what holds of every function with that contract. The
 * part's own harness proves that it is one.
 */
#ifndef VOTER_STAND_INS_H
#define VOTER_STAND_INS_H

#include "voter_contracts.h"

float keel_voter_agreement_stand_in(float distance, float agree, float none)
{
    const float s = nondet_float();

    __CPROVER_assert(keel_voter_agreement_may(distance, agree, none),
                     "precondition: keel_voter_agreement");
    __CPROVER_assume(keel_voter_agreement_does(s, distance, agree, none));
    return s;
}

float keel_voter_weight_stand_in(const float agreement[], uint32_t others)
{
    const float w = nondet_float();

    __CPROVER_assert(keel_voter_weight_may(agreement, others), "precondition: keel_voter_weight");
    __CPROVER_assume(keel_voter_weight_does(w, agreement, others));
    return w;
}

/* What the quotient was asked of, for harnesses that check eq. 18 in numbers. */
static float stand_in_sum;
static float stand_in_weights;

float keel_voter_mean_stand_in(float sum, float weights, float least, float most)
{
    const float mean = nondet_float();

    stand_in_sum = sum;
    stand_in_weights = weights;
    __CPROVER_assert(keel_voter_mean_may(sum, weights, least, most),
                     "precondition: keel_voter_mean");
    __CPROVER_assume(keel_voter_mean_does(mean, least, most));
    return mean;
}

/* What was asked of whom, and the answer: two circuits that subtract are hard to find equal. */
static float stand_in_least;
static float stand_in_most;
static float stand_in_agree;
static bool stand_in_within;

bool keel_voter_within_stand_in(float least, float most, float agree)
{
    const bool within = nondet_bool();

    stand_in_least = least;
    stand_in_most = most;
    stand_in_agree = agree;
    stand_in_within = within;
    __CPROVER_assert(keel_voter_within_may(least, most, agree), "precondition: keel_voter_within");
    __CPROVER_assume(keel_voter_within_does(within, least, most, agree));
    return within;
}

float keel_voter_combine_stand_in(const keel_voter_sample_t sample[], const float weight[],
                                  uint32_t sensors)
{
    const float mean = nondet_float();

    __CPROVER_assert(keel_voter_combine_may(sample, weight, sensors),
                     "precondition: keel_voter_combine");
    __CPROVER_assume(keel_voter_combine_does(mean, sample, weight, sensors));
    return mean;
}

#endif
