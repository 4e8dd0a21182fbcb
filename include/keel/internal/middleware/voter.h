/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file internal/middleware/voter.h
 * @brief The contracts of voter.h, and the functions that no user calls.
 */
#ifndef KEEL_INTERNAL_MIDDLEWARE_VOTER_H
#define KEEL_INTERNAL_MIDDLEWARE_VOTER_H

#include "keel/c_declarations.h"
#include "keel/middleware/voter.h"

KEEL_C_BEGIN

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

/*@ requires \valid(voter) && 2 <= voter->config.sensors <= KEEL_VOTER_SENSORS;
  @ requires vote_valid: voter_valid(voter);
  @ requires \valid_read(sample + (0 .. voter->config.sensors - 1));
  @ requires \separated(voter, sample + (0 .. voter->config.sensors - 1));
  @ assigns voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].last,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].unchanged_votes,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].condemned_votes,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].density,
  @     voter->sensor[0 .. KEEL_VOTER_SENSORS - 1].latched, voter->vote, voter->unanimous;
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
