/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter.h
 * @brief One channel of a weighted average voter over 2 to 4 redundant sensors (eq. 16 to 18).
 *
 * Sensors that measure the same quantity vote on it. Each pair's agreement, 0 to 1, falls with the
 * distance of their samples; a sensor's weight is the mean of its agreements with the others, and
 * the output the weighted mean. Whatever the samples are, NaN and infinities included, the output
 * is finite and lies between the smallest and the largest sample that contributed to it.
 *
 * Where the formulas are silent, the voter does this:
 *
 *   - A sample that is missing, not finite, implausible, late or stale has weight 0, and the vote
 *     says why. So has one that agrees with no other.
 *   - Three or four usable samples that all disagree (all weights are 0): their median is the
 *     output, marked as such. It lies among the healthy ones whatever one faulty sensor gives.
 *   - Two usable samples that disagree, or none that is usable: the last output is held; the vote
 *     says for how many samples and how long.
 *   - Only one usable sample: it is the output, marked as confirmed by nobody.
 *   - A sensor is latched as faulty, and takes part no more from the next vote on, when it was
 *     condemned in latch_count consecutive votes. A vote condemns a sensor whose own sample is
 *     unusable while another's is usable, and one that agrees with none while others agree. Where
 *     nobody agrees, or nothing is usable, nobody knows who is wrong: such a vote condemns none.
 *     So one sensor at least is never latched.
 *   - A latched sensor is on probation where keel_voter_reconsider is called after each vote: it is
 *     readmitted after readmit_count such votes in a row for which its sample was usable and within
 *     a of the output, or in which there was no output.
 *   - A sensor that repeats its sample bit for bit in stale_count votes is stale, whatever the
 *     others do: two that freeze together do not outvote the one that lives.
 *   - Two equal faulty sensors that are not frozen outvote a healthy third. No voter over three can
 *     tell.
 *   - A bias that keeps some agreement is neither removed nor latched. While the other two of three
 *     are within a of each other, its influence on the output is bounded (VOT-015); farther apart
 *     they agree less, and it moves the output farther.
 *
 * Sensors differ by a part of what they measure, too. keel_voter_scale, asked before a vote, lets a
 * grow with the last output: a = agree + slope |output|. All that is said of a holds with that a.
 *
 * keel_voter_step takes any vote. keel_voter_step_unanimous, tried first, takes the usual one for
 * less: the virtual unit (virtual_imu.h) does so.
 */
#ifndef KEEL_MIDDLEWARE_VOTER_H
#define KEEL_MIDDLEWARE_VOTER_H

#include "keel/c_declarations.h"
#include "keel/status.h"

#include <stdbool.h>
#include <stdint.h>

KEEL_C_BEGIN

/** The most sensors that can vote: 2 to 4. The proofs are for 4, channels of fewer included. */
#ifndef KEEL_VOTER_SENSORS
#define KEEL_VOTER_SENSORS 4u
#endif
/** The smallest (2^-10) and the largest distance of full agreement, in the channel's unit. */
#define KEEL_VOTER_AGREE_MIN 0.0009765625f
#define KEEL_VOTER_AGREE_MAX 1.0e3f
/** The largest magnitude of a plausible sample and of n a, in the channel's unit. */
#define KEEL_VOTER_RANGE 1.0e6f

/* How a vote took a sensor's sample: keel_vote_t, reason. */
#define KEEL_VOTER_USED         0u /**< It contributed. */
#define KEEL_VOTER_OUTVOTED     1u /**< Usable, but it agrees with no other usable sample. */
#define KEEL_VOTER_LATCHED      2u /**< The sensor is latched as faulty. */
#define KEEL_VOTER_MISSING      3u /**< The sensor gave none. */
#define KEEL_VOTER_NOT_FINITE   4u /**< It is NaN or infinite. */
#define KEEL_VOTER_OUT_OF_RANGE 5u /**< It lies outside the plausibility limits. */
#define KEEL_VOTER_LATE         6u /**< It is older than max_age_us. */
#define KEEL_VOTER_STALE        7u /**< The sensor repeats itself: it is frozen. */

/* How the output of a vote came about: keel_vote_t, state. */
#define KEEL_VOTER_MEAN     0u /**< The weighted mean of two samples or more. */
#define KEEL_VOTER_SINGLE   1u /**< The only usable sample, confirmed by none. */
#define KEEL_VOTER_MEDIAN   2u /**< The median of three or four samples that all disagree. */
#define KEEL_VOTER_DISAGREE 3u /**< Held: the two usable samples disagree. */
#define KEEL_VOTER_NONE     4u /**< Held: no sample is usable. */

/** How a channel votes. All lengths in the channel's own unit, say rad/s. */
typedef struct keel_voter_config {
    float agree;   /**< a of eq. 16: full agreement up to this distance; AGREE_MIN to AGREE_MAX. */
    float cutoff;  /**< n of eq. 16: no agreement from n a on; above 1, n a at most RANGE. */
    float slope;   /**< a grows by so much with the output's magnitude; 0 to 1. */
    float lowest;  /**< The smallest plausible sample, at least -RANGE. */
    float highest; /**< The largest plausible sample, at least the smallest, at most RANGE. */
    float initial; /**< The output before the first vote that has one; plausible. */
    uint32_t max_age_us;    /**< An older sample is late; at least 1. */
    uint16_t latch_count;   /**< Condemned in so many consecutive votes: latched; at least 1. */
    uint16_t stale_count;   /**< Unchanged in so many consecutive votes: stale; 0: never. */
    uint16_t readmit_count; /**< Votes of probation; 0: a latched sensor stays so. */
    uint16_t density_limit; /**< The leaky count that latches; 0: never (as the paper). */
    uint8_t sensors;        /**< N: how many sensors vote, 2 to KEEL_VOTER_SENSORS. */
} keel_voter_config_t;

/** One sensor's sample. The value may be any bit pattern. */
typedef struct keel_voter_sample {
    float value;     /**< In the channel's unit. */
    uint32_t age_us; /**< How long ago it was taken, in us. */
    bool present;    /**< Whether the sensor gave one; else value and age do not matter. */
} keel_voter_sample_t;

/** The result of a vote. The slots of sensors that do not exist are 0. */
typedef struct keel_vote {
    float output;                       /**< In the channel's unit. */
    float weight[KEEL_VOTER_SENSORS];   /**< Eq. 17 with 1/(N - 1), 0 to 1. */
    uint32_t held;                      /**< Consecutive votes without output; saturates. */
    uint32_t held_us;                   /**< How long that is, in us; saturates. */
    uint8_t reason[KEEL_VOTER_SENSORS]; /**< KEEL_VOTER_USED, or why the weight is 0. */
    uint8_t state;                      /**< KEEL_VOTER_MEAN, ... */
    uint8_t contributing;               /**< How many sensors contributed. */
} keel_vote_t;

/** A sensor as the voter remembers it. */
typedef struct keel_voter_sensor {
    float last;               /**< Its last finite sample; at first the initial output. */
    uint16_t unchanged_votes; /**< Votes in a row whose finite samples did not change; saturates. */
    uint16_t condemned_votes; /**< Consecutive votes that condemned it; saturates. */
    uint16_t density;         /**< One up per vote that condemned it, one down per agreement. */
    uint16_t probation;       /**< Consecutive votes that speak for it while it is latched. */
    bool latched;             /**< Whether it is latched as faulty. */
} keel_voter_sensor_t;

/** A channel. Only the functions below write it; all of it may be read. */
typedef struct keel_voter {
    keel_voter_config_t config;
    float agree;    /**< a of the next vote: config.agree, until keel_voter_scale is called. */
    float disagree; /**< n a: samples that differ by this or more do not agree at all. */
    keel_voter_sensor_t sensor[KEEL_VOTER_SENSORS];
    keel_vote_t vote; /**< The last one. */
    bool unanimous;   /**< All weights were 1 in it, and nothing is counted against any sensor. */
} keel_voter_t;

/*@ predicate agreement_valid(keel_voter_config_t c) =
  @     \is_finite(c.agree) && KEEL_VOTER_AGREE_MIN <= c.agree <= KEEL_VOTER_AGREE_MAX &&
  @     \is_finite(c.slope) && 0 <= c.slope <= 1;
  @ predicate cutoff_valid(keel_voter_config_t c) =
  @     \is_finite(c.cutoff) && 1 < c.cutoff <= KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN &&
  @     c.agree < (float)(c.cutoff * c.agree) <= KEEL_VOTER_RANGE;
  @ predicate limits_valid(keel_voter_config_t c) =
  @     \is_finite(c.lowest) && \is_finite(c.highest) &&
  @     -KEEL_VOTER_RANGE <= c.lowest <= c.highest <= KEEL_VOTER_RANGE;
  @ predicate initial_valid(keel_voter_config_t c) =
  @     \is_finite(c.initial) && c.lowest <= c.initial <= c.highest;
  @ predicate voter_config_valid(keel_voter_config_t c) =
  @     2 <= c.sensors <= KEEL_VOTER_SENSORS && agreement_valid(c) && cutoff_valid(c) &&
  @     limits_valid(c) && initial_valid(c) && c.max_age_us > 0 && c.latch_count > 0;
  @
  @ // A sensor below its counts: the vote that takes it there latches it.
  @ predicate voter_healthy(keel_voter_config_t c, keel_voter_sensor_t s) =
  @     s.condemned_votes < c.latch_count && (c.density_limit > 0 ==> s.density < c.density_limit);
  @
  @ // The last vote was the mean of all samples with weight 1, and nothing is counted against any.
  @ predicate voter_unanimous(keel_voter_t *v) =
  @     v->vote.state == KEEL_VOTER_MEAN && v->vote.contributing == v->config.sensors &&
  @     v->vote.held == 0 && v->vote.held_us == 0 &&
  @     (\forall integer i; 0 <= i < v->config.sensors ==> !v->sensor[i].latched &&
  @         v->sensor[i].unchanged_votes == 0 && v->sensor[i].condemned_votes == 0 &&
  @         v->sensor[i].density == 0 && v->vote.weight[i] == 1 &&
  @         v->vote.reason[i] == KEEL_VOTER_USED);
  @
  @ // How many of the first n sensors contributed.
  @ logic integer voter_used(keel_vote_t *vote, integer n) = (n <= 0) ? 0 :
  @     voter_used(vote, n - 1) + ((vote->reason[n - 1] == KEEL_VOTER_USED) ? 1 : 0);
  @
  @ // The thresholds of the next vote.
  @ predicate voter_thresholds(keel_voter_t *v) =
  @     \is_finite(v->agree) && KEEL_VOTER_AGREE_MIN <= v->agree <= KEEL_VOTER_AGREE_MAX &&
  @     \is_finite(v->disagree) && v->agree < v->disagree <= KEEL_VOTER_RANGE;
  @
  @ // This holds of a channel between any two calls.
  @ predicate voter_valid(keel_voter_t *v) =
  @     voter_config_valid(v->config) && voter_thresholds(v) &&
  @     \is_finite(v->vote.output) && v->config.lowest <= v->vote.output <= v->config.highest &&
  @     (v->unanimous ==> voter_unanimous(v)) &&
  @     \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==> \is_finite(v->sensor[i].last) &&
  @         (!v->sensor[i].latched ==> voter_healthy(v->config, v->sensor[i]));
  @*/

/**
 * Checks a configuration (requirement VOT-001): the fields in their order, the first that is wrong
 * gives the status.
 *
 * @param config the configuration; any bit pattern
 * @return KEEL_OK; KEEL_ERR_SENSORS, KEEL_ERR_AGREEMENT (agree, slope), KEEL_ERR_CUTOFF (cutoff),
 *         KEEL_ERR_LIMITS (lowest, highest), KEEL_ERR_INITIAL, KEEL_ERR_AGE (max_age_us) or
 *         KEEL_ERR_LATCH (latch_count): the field that is wrong
 */
/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures VOT_001_accepted: \result == KEEL_OK <==> voter_config_valid(*config);
  @ ensures VOT_001_sensors: \result == KEEL_ERR_SENSORS <==>
  @     !(2 <= config->sensors <= KEEL_VOTER_SENSORS);
  @ ensures VOT_001_agreement: \result == KEEL_ERR_AGREEMENT ==> !agreement_valid(*config);
  @ ensures VOT_001_cutoff: \result == KEEL_ERR_CUTOFF ==> !cutoff_valid(*config);
  @ ensures VOT_001_limits: \result == KEEL_ERR_LIMITS ==> !limits_valid(*config);
  @ ensures VOT_001_initial: \result == KEEL_ERR_INITIAL ==> !initial_valid(*config);
  @ ensures VOT_001_age: \result == KEEL_ERR_AGE ==> config->max_age_us == 0;
  @ ensures VOT_001_latch: \result == KEEL_ERR_LATCH ==> config->latch_count == 0;
  @*/
keel_status_t keel_voter_check(const keel_voter_config_t *config);

/**
 * Makes a channel ready for its first vote (requirement VOT-002). A copy of the configuration is
 * kept.
 *
 * @param voter  the channel
 * @param config how it votes
 * @return KEEL_OK, or what keel_voter_check returns; the channel is not touched then
 */
/*@ requires \valid(voter) && \valid_read(config) && \separated(voter, config);
  @ assigns *voter;
  @ behavior refused:
  @   assumes !voter_config_valid(*config);
  @   assigns \nothing;
  @   ensures VOT_002_refused: \result != KEEL_OK;
  @ behavior ready:
  @   assumes voter_config_valid(*config);
  @   ensures VOT_002_ready: \result == KEEL_OK && voter_valid(voter);
  @   ensures VOT_002_output: voter->vote.output == config->initial;
  @   ensures VOT_002_fresh: \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==>
  @       !voter->sensor[i].latched && voter->sensor[i].condemned_votes == 0 &&
  @       voter->sensor[i].density == 0 && voter->sensor[i].unchanged_votes == 0 &&
  @       voter->sensor[i].probation == 0;
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_voter_init(keel_voter_t *voter, const keel_voter_config_t *config);

/**
 * Sets a for the next vote by the last output (requirement VOT-019): a = agree + slope |output|, at
 * most KEEL_VOTER_AGREE_MAX, and n a with it. Where n a would exceed KEEL_VOTER_RANGE, both are
 * those of the configuration.
 *
 * @param voter the channel, initialised
 */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires scale_valid: voter_valid(voter);
  @ assigns voter->agree, voter->disagree;
  @ ensures VOT_019_thresholds: voter_thresholds(voter) && voter->config.agree <= voter->agree;
  @ ensures VOT_019_constant: voter->config.slope == 0 ==> voter->agree == voter->config.agree;
  @*/
void keel_voter_scale(keel_voter_t *voter);

/**
 * The agreement of two samples at the distance d (eq. 16, requirements VOT-003 and VOT-004): 1 up
 * to a, 0 from n a on, (n a - d)/(n a - a) between. In this form the quotient never exceeds 1,
 * where that of eq. 16 does once it is rounded.
 *
 * @param x        a sample, in magnitude at most KEEL_VOTER_RANGE
 * @param y        another
 * @param agree    a, KEEL_VOTER_AGREE_MIN to KEEL_VOTER_AGREE_MAX: up to here they agree fully
 * @param disagree n a, above a, at most KEEL_VOTER_RANGE: from here on not at all
 * @return the agreement, 0 to 1; 0 from n a on only
 */
/*@ requires agreement_samples: \is_finite(x) && \is_finite(y) &&
  @     -KEEL_VOTER_RANGE <= x <= KEEL_VOTER_RANGE && -KEEL_VOTER_RANGE <= y <= KEEL_VOTER_RANGE;
  @ requires \is_finite(agree) && KEEL_VOTER_AGREE_MIN <= agree <= KEEL_VOTER_AGREE_MAX;
  @ requires agreement_disagree: \is_finite(disagree) && agree < disagree <= KEEL_VOTER_RANGE;
  @ assigns \nothing;
  @ ensures VOT_003_full: -agree <= (float)(x - y) <= agree ==> \result == 1;
  @ ensures VOT_003_none:
  @     (float)(x - y) <= -disagree || disagree <= (float)(x - y) ==> \result == 0;
  @ ensures VOT_003_some: -disagree < (float)(x - y) < disagree ==> \result > 0;
  @ ensures VOT_004: \is_finite(\result) && 0 <= \result <= 1;
  @*/
float keel_voter_agreement(float x, float y, float agree, float disagree);

/*@ // A weight, or an agreement, that a quotient can do with: 0, or not below 2^-24 / 3.
  @ predicate weight_valid(float w) = \is_finite(w) && (w == 0 || 0x1p-26 <= w <= 1);
  @*/

/**
 * The weight of a sample (eq. 17, requirement VOT-006): the mean of its agreements with the others.
 *
 * @param agreement its agreements, each 0 or from 2^-24 to 1
 * @param others    how many there are, N - 1: 1 to KEEL_VOTER_SENSORS - 1
 * @return the weight, 0 to 1; 0 only when all agreements are
 */
/*@ requires 1 <= others < KEEL_VOTER_SENSORS && \valid_read(agreement + (0 .. others - 1));
  @ requires weight_agreements: \forall integer i; 0 <= i < others ==>
  @     \is_finite(agreement[i]) && (agreement[i] == 0 || 0x1p-24 <= agreement[i] <= 1);
  @ assigns \nothing;
  @ ensures VOT_006_range: weight_valid(\result);
  @ ensures VOT_006_null: \result == 0 <==>
  @     \forall integer i; 0 <= i < others ==> agreement[i] == 0;
  @*/
float keel_voter_weight(const float agreement[], uint32_t others);

/**
 * The quotient of eq. 18, clamped to the samples it is of (requirement VOT-005): rounded, it may
 * leave them by a few units in the last place (VOT-016).
 *
 * @param sum     of the products of weights and samples
 * @param weights the sum of the weights, at least 2^-26
 * @param least   the smallest sample
 * @param most    the largest sample
 * @return the mean, from least to most
 */
/*@ requires mean_sum: \is_finite(sum) && -4 * KEEL_VOTER_RANGE <= sum <= 4 * KEEL_VOTER_RANGE;
  @ requires mean_weights: \is_finite(weights) && 0x1p-26 <= weights <= 4;
  @ requires mean_ends: \is_finite(least) && \is_finite(most) &&
  @     -KEEL_VOTER_RANGE <= least <= most <= KEEL_VOTER_RANGE;
  @ assigns \nothing;
  @ ensures VOT_005_mean: \is_finite(\result) && least <= \result <= most;
  @*/
float keel_voter_mean(float sum, float weights, float least, float most);

/**
 * The mean of samples that all have the weight 1: what keel_voter_combine gives then (requirement
 * VOT-018).
 *
 * @param sample  the samples
 * @param sensors how many there are, 2 to KEEL_VOTER_SENSORS
 * @param least   the smallest of them
 * @param most    the largest
 * @return the mean, from least to most
 */
/*@ requires 2 <= sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. sensors - 1));
  @ requires plain_ends: \is_finite(least) && \is_finite(most) &&
  @     -KEEL_VOTER_RANGE <= least <= most <= KEEL_VOTER_RANGE;
  @ requires plain_samples: \forall integer i; 0 <= i < sensors ==>
  @     \is_finite(sample[i].value) && least <= sample[i].value <= most;
  @ assigns \nothing;
  @ ensures VOT_018_mean: \is_finite(\result) && least <= \result <= most;
  @*/
float keel_voter_plain_mean(const keel_voter_sample_t sample[], uint32_t sensors, float least,
                            float most);

/**
 * Whether samples lie within a of each other (requirement VOT-018). It is enough to look at the
 * smallest and the largest: no pair's distance, rounded, exceeds theirs.
 *
 * @param least the smallest sample
 * @param most  the largest sample
 * @param agree a, KEEL_VOTER_AGREE_MIN to KEEL_VOTER_AGREE_MAX
 * @return whether they do
 */
/*@ requires within_ends: \is_finite(least) && \is_finite(most) &&
  @     -KEEL_VOTER_RANGE <= least <= most <= KEEL_VOTER_RANGE;
  @ requires \is_finite(agree) && KEEL_VOTER_AGREE_MIN <= agree <= KEEL_VOTER_AGREE_MAX;
  @ assigns \nothing;
  @ ensures VOT_018_within: \result <==> (float)(most - least) <= agree;
  @*/
bool keel_voter_within(float least, float most, float agree);

/**
 * The weighted mean of samples (eq. 18, requirement VOT-005). Rounded, the quotient may leave the
 * samples by a few units in the last place (VOT-016), so it is clamped to those that contribute.
 *
 * @param sample  the samples; those with a weight are finite, in magnitude at most
 *                KEEL_VOTER_RANGE
 * @param weight  their weights: 0, or 2^-26 to 1, not all of them 0
 * @param sensors how many there are, 2 to KEEL_VOTER_SENSORS
 * @return the mean, between the smallest and the largest sample with a weight
 */
/*@ requires 2 <= sensors <= KEEL_VOTER_SENSORS;
  @ requires \valid_read(sample + (0 .. sensors - 1)) && \valid_read(weight + (0 .. sensors - 1));
  @ requires combine_weights: \forall integer i; 0 <= i < sensors ==> weight_valid(weight[i]);
  @ requires combine_samples: \forall integer i; 0 <= i < sensors && weight[i] > 0 ==>
  @     \is_finite(sample[i].value) &&
  @     -KEEL_VOTER_RANGE <= sample[i].value <= KEEL_VOTER_RANGE;
  @ requires combine_some: \exists integer i; 0 <= i < sensors && weight[i] > 0;
  @ assigns \nothing;
  @ ensures VOT_005_finite: \is_finite(\result);
  @ ensures VOT_005_above: \exists integer i; 0 <= i < sensors && weight[i] > 0 &&
  @     sample[i].value <= \result;
  @ ensures VOT_005_below: \exists integer i; 0 <= i < sensors && weight[i] > 0 &&
  @     \result <= sample[i].value;
  @*/
float keel_voter_combine(const keel_voter_sample_t sample[], const float weight[],
                         uint32_t sensors);

/**
 * Takes one vote (requirements VOT-005 to VOT-013, VOT-020 to VOT-022). Its result is in
 * voter->vote.
 *
 * @param voter      the channel, initialised
 * @param sample     a sample per sensor, N of them, in the order of the sensors; any bit pattern
 * @param elapsed_us the time since the last vote, in us: how long a held output lasts
 */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires vote_valid: voter_valid(voter);
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1], voter->vote, voter->unanimous;
  @ ensures VOT_005_valid: voter_valid(voter);
  @ ensures VOT_005_hull: voter->vote.state < KEEL_VOTER_DISAGREE ==>
  @     (\exists integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.reason[i] == KEEL_VOTER_USED && sample[i].value <= voter->vote.output) &&
  @     (\exists integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.reason[i] == KEEL_VOTER_USED && voter->vote.output <= sample[i].value);
  @ ensures VOT_006_weights: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     0 <= voter->vote.weight[i] <= 1;
  @ ensures VOT_006_reason: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (voter->vote.weight[i] > 0 <==> voter->vote.reason[i] == KEEL_VOTER_USED);
  @ ensures VOT_006_contributing:
  @     voter->vote.contributing == voter_used(&voter->vote, voter->config.sensors);
  @ ensures VOT_007_latched: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (\old(voter->sensor[i].latched) <==> voter->vote.reason[i] == KEEL_VOTER_LATCHED);
  @ ensures VOT_007_missing: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (voter->vote.reason[i] == KEEL_VOTER_MISSING <==>
  @         (!\old(voter->sensor[i].latched) && !sample[i].present));
  @ ensures VOT_007_finite: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (voter->vote.reason[i] == KEEL_VOTER_NOT_FINITE <==>
  @         (!\old(voter->sensor[i].latched) && sample[i].present &&
  @             !\is_finite(sample[i].value)));
  @ ensures VOT_007_usable: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (voter->vote.reason[i] <= KEEL_VOTER_OUTVOTED || voter->vote.reason[i] == KEEL_VOTER_STALE)
  @         ==> (sample[i].present && \is_finite(sample[i].value) &&
  @             voter->config.lowest <= sample[i].value <= voter->config.highest &&
  @             sample[i].age_us <= voter->config.max_age_us);
  @ ensures VOT_008_hold: voter->vote.state >= KEEL_VOTER_DISAGREE ==>
  @     voter->vote.output == \old(voter->vote.output);
  @ ensures VOT_008_held: voter->vote.held == ((voter->vote.state < KEEL_VOTER_DISAGREE) ? 0 :
  @     ((\old(voter->vote.held) < UINT32_MAX) ? \old(voter->vote.held) + 1 : UINT32_MAX));
  @ ensures VOT_008_held_us: voter->vote.held_us == ((voter->vote.state < KEEL_VOTER_DISAGREE) ? 0
  @     : \min(\old(voter->vote.held_us) + elapsed_us, UINT32_MAX));
  @ ensures VOT_009_single: voter->vote.state == KEEL_VOTER_SINGLE ==>
  @     \exists integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.reason[i] == KEEL_VOTER_USED && voter->vote.output == sample[i].value;
  @ ensures VOT_010_count: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     !\old(voter->sensor[i].latched) ==>
  @     (voter->sensor[i].condemned_votes == 0 ||
  @      voter->sensor[i].condemned_votes == \old(voter->sensor[i].condemned_votes) ||
  @      voter->sensor[i].condemned_votes == \old(voter->sensor[i].condemned_votes) + 1);
  @ ensures VOT_010_condemned: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->vote.reason[i] >= KEEL_VOTER_MISSING && voter->vote.state != KEEL_VOTER_NONE ==>
  @         voter->sensor[i].condemned_votes ==
  @             \min(\old(voter->sensor[i].condemned_votes) + 1, UINT16_MAX);
  @ ensures VOT_010_nobody: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     !\old(voter->sensor[i].latched) && voter->vote.state == KEEL_VOTER_NONE ==>
  @         voter->sensor[i].condemned_votes == \old(voter->sensor[i].condemned_votes);
  @ ensures VOT_010_clear: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->vote.reason[i] == KEEL_VOTER_USED ==> voter->sensor[i].condemned_votes == 0;
  @ ensures VOT_011_latch: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     !\old(voter->sensor[i].latched) ==>
  @     (voter->sensor[i].latched <==>
  @         (voter->sensor[i].condemned_votes >= voter->config.latch_count ||
  @          (voter->config.density_limit > 0 &&
  @           voter->sensor[i].density >= voter->config.density_limit)));
  @ ensures VOT_011_stays: \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==>
  @     \old(voter->sensor[i].latched) ==> voter->sensor[i].latched;
  @ ensures VOT_012_density: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     (voter->vote.reason[i] == KEEL_VOTER_USED ==> voter->sensor[i].density ==
  @         ((\old(voter->sensor[i].density) > 0) ? \old(voter->sensor[i].density) - 1 : 0));
  @ ensures VOT_013_stale: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->vote.reason[i] == KEEL_VOTER_STALE ==>
  @         (0 < voter->config.stale_count <= voter->sensor[i].unchanged_votes);
  @ ensures VOT_013_by_itself: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->vote.reason[i] == KEEL_VOTER_USED ==>
  @         (voter->config.stale_count == 0 ||
  @          voter->sensor[i].unchanged_votes < voter->config.stale_count);
  @ ensures VOT_013_count: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->vote.reason[i] == KEEL_VOTER_USED ==>
  @         voter->sensor[i].last == sample[i].value &&
  @         voter->sensor[i].unchanged_votes == ((sample[i].value != \old(voter->sensor[i].last))
  @             ? 0 : \min(\old(voter->sensor[i].unchanged_votes) + 1, UINT16_MAX));
  @ ensures VOT_020_middle: voter->vote.state == KEEL_VOTER_MEDIAN ==>
  @     1 <= voter->vote.contributing <= 2 &&
  @     \forall integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.reason[i] == KEEL_VOTER_USED ==>
  @             (\exists integer j; 0 <= j < voter->config.sensors &&
  @                 voter->vote.reason[j] == KEEL_VOTER_OUTVOTED &&
  @                 sample[j].value < sample[i].value) &&
  @             (\exists integer j; 0 <= j < voter->config.sensors &&
  @                 voter->vote.reason[j] == KEEL_VOTER_OUTVOTED &&
  @                 sample[i].value < sample[j].value);
  @ ensures VOT_020_nobody: voter->vote.state == KEEL_VOTER_MEDIAN ==>
  @     \forall integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.reason[i] == KEEL_VOTER_OUTVOTED ==>
  @             voter->sensor[i].condemned_votes == \old(voter->sensor[i].condemned_votes);
  @ ensures VOT_022_one_stays:
  @     (\exists integer i; 0 <= i < voter->config.sensors && !\old(voter->sensor[i].latched)) ==>
  @     (\exists integer i; 0 <= i < voter->config.sensors && !voter->sensor[i].latched);
  @*/
void keel_voter_step(keel_voter_t *voter, const keel_voter_sample_t sample[], uint32_t elapsed_us);

/**
 * Takes a vote if it is as unanimous as the last one (requirement VOT-018), at about a third of
 * what keel_voter_step costs: when all samples are plausible and none is late, all lie within a of
 * each other, and all have changed. With all weights 1 the mean of eq. 18 is the plain one.
 * Else nothing changes, and the vote is left to keel_voter_step.
 *
 * @param voter     the channel, initialised
 * @param sample    a sample per sensor, N of them, all present; their values any bit pattern
 * @param oldest_us the age of the oldest, in us; that of each sample is not read
 * @return whether the vote was taken; its result is in voter->vote then
 */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires attempt_valid: voter_valid(voter);
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ requires \forall integer i; 0 <= i < voter->config.sensors ==>
  @     sample[i].present && sample[i].age_us <= oldest_us;
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].last, voter->vote.output;
  @ ensures VOT_018_valid: voter_valid(voter);
  @ ensures VOT_018_taken: \result <==>
  @     (\old(voter->unanimous) && oldest_us <= voter->config.max_age_us &&
  @      (\forall integer i; 0 <= i < voter->config.sensors ==> \is_finite(sample[i].value) &&
  @          voter->config.lowest <= sample[i].value <= voter->config.highest &&
  @          sample[i].value != \old(voter->sensor[i].last)) &&
  @      (\forall integer i, j; 0 <= i < j < voter->config.sensors ==>
  @          -voter->agree <= (float)(sample[i].value - sample[j].value) <= voter->agree));
  @ ensures VOT_018_last: \result ==> \forall integer i; 0 <= i < voter->config.sensors ==>
  @     voter->sensor[i].last == sample[i].value;
  @ ensures VOT_018_hull: \result ==>
  @     (\exists integer i; 0 <= i < voter->config.sensors &&
  @         sample[i].value <= voter->vote.output) &&
  @     (\exists integer i; 0 <= i < voter->config.sensors &&
  @         voter->vote.output <= sample[i].value);
  @ ensures VOT_018_refused: !\result ==> voter->vote.output == \old(voter->vote.output) &&
  @     \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==>
  @         voter->sensor[i].last == \old(voter->sensor[i].last);
  @*/
bool keel_voter_step_unanimous(keel_voter_t *voter, const keel_voter_sample_t sample[],
                               uint32_t oldest_us);

/**
 * Readmits a latched sensor (requirement VOT-014): it votes again from the next vote on, with all
 * its counts at 0.
 *
 * @param voter  the channel
 * @param sensor its index
 * @return KEEL_OK; KEEL_ERR_SENSORS when there is no such sensor, KEEL_ERR_STATE when it is not
 *         latched
 */
/*@ requires \valid(voter) && voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1];
  @ behavior unknown:
  @   assumes sensor >= voter->config.sensors;
  @   assigns \nothing;
  @   ensures VOT_014_unknown: \result == KEEL_ERR_SENSORS;
  @ behavior healthy:
  @   assumes sensor < voter->config.sensors;
  @   assumes !voter->sensor[sensor].latched;
  @   assigns \nothing;
  @   ensures VOT_014_healthy: \result == KEEL_ERR_STATE;
  @ behavior latched:
  @   assumes sensor < voter->config.sensors;
  @   assumes voter->sensor[sensor].latched;
  @   assigns voter->sensor[sensor];
  @   ensures VOT_014_readmitted: \result == KEEL_OK && !voter->sensor[sensor].latched &&
  @       voter->sensor[sensor].condemned_votes == 0 && voter->sensor[sensor].density == 0 &&
  @       voter->sensor[sensor].unchanged_votes == 0 && voter->sensor[sensor].probation == 0;
  @   ensures VOT_014_last: voter->sensor[sensor].last == \old(voter->sensor[sensor].last);
  @ complete behaviors;
  @ disjoint behaviors;
  @*/
keel_status_t keel_voter_readmit(keel_voter_t *voter, uint32_t sensor);

/**
 * Puts latched sensors on probation (requirement VOT-021), after a vote, with its samples: a sensor
 * is readmitted, as by keel_voter_readmit, after readmit_count calls in a row for which its sample
 * was usable, was not stale, and lay within a of the output of the vote, or the vote had none.
 *
 * @param voter  the channel, after a vote
 * @param sample the samples of that vote
 */
/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires probation_valid: voter_valid(voter);
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1];
  @ ensures VOT_021_valid: voter_valid(voter);
  @ ensures VOT_021_healthy: \forall integer i; 0 <= i < KEEL_VOTER_SENSORS ==>
  @     !\old(voter->sensor[i].latched) ==> !voter->sensor[i].latched &&
  @         voter->sensor[i].last == \old(voter->sensor[i].last) &&
  @         voter->sensor[i].unchanged_votes == \old(voter->sensor[i].unchanged_votes) &&
  @         voter->sensor[i].condemned_votes == \old(voter->sensor[i].condemned_votes) &&
  @         voter->sensor[i].density == \old(voter->sensor[i].density) &&
  @         voter->sensor[i].probation == \old(voter->sensor[i].probation);
  @ ensures VOT_021_readmitted: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     \old(voter->sensor[i].latched) && !voter->sensor[i].latched ==>
  @         0 < voter->config.readmit_count <= \old(voter->sensor[i].probation) + 1 &&
  @         sample[i].present && \is_finite(sample[i].value) &&
  @         voter->config.lowest <= sample[i].value <= voter->config.highest &&
  @         sample[i].age_us <= voter->config.max_age_us &&
  @         voter->sensor[i].condemned_votes == 0 && voter->sensor[i].density == 0 &&
  @         voter->sensor[i].probation == 0;
  @ ensures VOT_021_agrees: \forall integer i; 0 <= i < voter->config.sensors ==>
  @     \old(voter->sensor[i].latched) && !voter->sensor[i].latched &&
  @         voter->vote.contributing > 0 ==>
  @             -voter->agree <= (float)(sample[i].value - voter->vote.output) <= voter->agree;
  @*/
void keel_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[]);

KEEL_C_END

#endif
