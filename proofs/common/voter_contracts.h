/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter_contracts.h
 * @brief The contracts of the voter's parts, for CBMC: what their own harnesses prove, and what
 *        stands in for them where a whole vote is proved.
 *
 * Each part has a precondition and a postcondition, one text for both uses. Its own harness assumes
 * the one, calls the part and asserts the other. A stand-in asserts the one and returns anything
 * that satisfies the other.
 */
#ifndef VOTER_CONTRACTS_H
#define VOTER_CONTRACTS_H

#include "voter_proof.h"

static bool in_range_here(float x)
{
    return (-KEEL_VOTER_RANGE <= x) && (x <= KEEL_VOTER_RANGE);
}

static bool keel_voter_agreement_may(float x, float y, float agree, float disagree)
{
    return (KEEL_VOTER_AGREE_MIN <= agree) && (agree <= KEEL_VOTER_AGREE_MAX) &&
           disagree_valid_here(agree, disagree) && in_range_here(x) && in_range_here(y);
}

/* 2^-24 is the least that is not 0: too small a weight could not be divided by. */
static bool agreement_range(float s)
{
    return (s == 0.0f) || ((0x1p-24f <= s) && (s <= 1.0f));
}

static bool keel_voter_agreement_does(float s)
{
    return agreement_range(s);
}

static bool keel_voter_weight_may(const float agreement[], uint32_t others)
{
    bool may = (1u <= others) && (others < SENSORS);

    for (uint32_t i = 0u; i < (SENSORS - 1u); i++) {
        may = may && ((i >= others) || agreement_range(agreement[i]));
    }
    return may;
}

static bool weight_range(float w)
{
    return (w == 0.0f) || ((0x1p-26f <= w) && (w <= 1.0f));
}

static bool keel_voter_weight_does(float w, const float agreement[], uint32_t others)
{
    bool null = true;

    for (uint32_t i = 0u; i < (SENSORS - 1u); i++) {
        null = null && ((i >= others) || (agreement[i] == 0.0f));
    }
    return weight_range(w) && ((w == 0.0f) == null);
}

static bool keel_voter_mean_may(float sum, float weights, float least, float most)
{
    return (-4.0f * KEEL_VOTER_RANGE <= sum) && (sum <= 4.0f * KEEL_VOTER_RANGE) &&
           (0x1p-26f <= weights) && (weights <= 4.0f) && (-KEEL_VOTER_RANGE <= least) &&
           (least <= most) && (most <= KEEL_VOTER_RANGE);
}

static bool keel_voter_mean_does(float mean, float least, float most)
{
    return (least <= mean) && (mean <= most);
}

static bool keel_voter_plain_mean_may(const keel_voter_sample_t sample[], uint32_t sensors,
                                      float least, float most)
{
    bool may = (2u <= sensors) && (sensors <= SENSORS) && (-KEEL_VOTER_RANGE <= least) &&
               (least <= most) && (most <= KEEL_VOTER_RANGE);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        may = may && ((i >= sensors) || ((least <= sample[i].value) && (sample[i].value <= most)));
    }
    return may;
}

static bool keel_voter_plain_mean_does(float mean, float least, float most)
{
    return (least <= mean) && (mean <= most);
}

static bool keel_voter_within_may(float least, float most, float agree)
{
    return (-KEEL_VOTER_RANGE <= least) && (least <= most) && (most <= KEEL_VOTER_RANGE) &&
           (KEEL_VOTER_AGREE_MIN <= agree) && (agree <= KEEL_VOTER_AGREE_MAX);
}

static bool keel_voter_within_does(bool within, float least, float most)
{
    return within || (least < most);
}

static bool keel_voter_combine_may(const keel_voter_sample_t sample[], const float weight[],
                                   uint32_t sensors)
{
    bool may = (2u <= sensors) && (sensors <= SENSORS);
    bool some = false;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (i < sensors) {
            may = may && weight_range(weight[i]) &&
                  ((weight[i] == 0.0f) || ((-KEEL_VOTER_RANGE <= sample[i].value) &&
                                           (sample[i].value <= KEEL_VOTER_RANGE)));
            some = some || (weight[i] > 0.0f);
        }
    }
    return may && some;
}

/* Whether a sample that has a weight does not lie above a value. */
static bool combine_above(float mean, const keel_voter_sample_t sample[], const float weight[],
                          uint32_t sensors)
{
    bool above = false;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        above = above || ((i < sensors) && (weight[i] > 0.0f) && (sample[i].value <= mean));
    }
    return above;
}

/* Whether a value lies among the samples that have a weight. */
static bool keel_voter_combine_does(float mean, const keel_voter_sample_t sample[],
                                    const float weight[], uint32_t sensors)
{
    bool below = false;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        below = below || ((i < sensors) && (weight[i] > 0.0f) && (mean <= sample[i].value));
    }
    return finite_here(mean) && combine_above(mean, sample, weight, sensors) && below;
}

#ifdef VOTER_FLOATS_OPEN
/* What voter_valid says of a channel's integers alone, for a harness of code that hands channels on
 * and looks at no float of them. It takes more channels for valid, before a call and after it; that
 * channels are valid in full where they are handed on is another harness's to show. */
static bool voter_valid_here(const keel_voter_t *v)
{
    bool clean = v->vote.contributing == v->config.sensors;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        clean = clean && ((i >= v->config.sensors) ||
                          (!v->sensor[i].latched && (v->vote.reason[i] == KEEL_VOTER_USED)));
    }
    return (2u <= v->config.sensors) && (v->config.sensors <= SENSORS) && (!v->unanimous || clean);
}
#else
/* voter_thresholds */
static bool thresholds_valid_here(const keel_voter_t *v)
{
    return (KEEL_VOTER_AGREE_MIN <= v->agree) && (v->agree <= KEEL_VOTER_AGREE_MAX) &&
           disagree_valid_here(v->agree, v->disagree);
}

/* voter_valid, but for the cut-off and the initial output: nothing but init reads these two. */
static bool voter_valid_here(const keel_voter_t *v)
{
    bool valid = (2u <= v->config.sensors) && (v->config.sensors <= SENSORS) &&
                 agreement_valid_here(&v->config) && limits_valid_here(&v->config) &&
                 thresholds_valid_here(v) && (v->config.max_age_us > 0u) &&
                 (v->config.latch_count > 0u) && (v->config.lowest <= v->vote.output) &&
                 (v->vote.output <= v->config.highest) && (!v->unanimous || unanimous_here(v));

    for (uint32_t i = 0u; i < SENSORS; i++) {
        valid = valid && finite_here(v->sensor[i].last) &&
                (v->sensor[i].latched || healthy_here(&v->config, &v->sensor[i]));
    }
    return valid;
}
#endif

static bool keel_voter_scale_may(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

static bool keel_voter_scale_does(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

static bool keel_voter_step_may(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

/* Who contributed is counted, and is not latched after the vote (VOT-006, VOT-010, VOT-011). */
static bool used_is_healthy_here(const keel_voter_t *v)
{
    bool healthy = true;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        healthy = healthy && ((i >= v->config.sensors) || (v->vote.reason[i] != KEEL_VOTER_USED) ||
                              ((v->vote.contributing > 0u) && !v->sensor[i].latched));
    }
    return healthy;
}

static bool keel_voter_step_does(const keel_voter_t *voter)
{
    return voter_valid_here(voter) && used_is_healthy_here(voter);
}

static bool keel_voter_reconsider_may(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

static bool keel_voter_reconsider_does(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

static bool keel_voter_step_unanimous_may(const keel_voter_t *voter,
                                          const keel_voter_sample_t sample[], uint32_t oldest_us)
{
    bool may = voter_valid_here(voter);

    for (uint32_t i = 0u; i < SENSORS; i++) {
        may = may && ((i >= voter->config.sensors) ||
                      (sample[i].present && (sample[i].age_us <= oldest_us)));
    }
    return may;
}

static bool keel_voter_step_unanimous_does(const keel_voter_t *voter)
{
    return voter_valid_here(voter);
}

#endif
