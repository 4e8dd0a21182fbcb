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

/**
 * Checks a configuration (requirement VOT-001): the fields in their order, the first that is wrong
 * gives the status.
 *
 * @param config the configuration; any bit pattern
 * @return KEEL_OK; KEEL_ERR_SENSORS, KEEL_ERR_AGREEMENT (agree, slope), KEEL_ERR_CUTOFF (cutoff),
 *         KEEL_ERR_LIMITS (lowest, highest), KEEL_ERR_INITIAL, KEEL_ERR_AGE (max_age_us) or
 *         KEEL_ERR_LATCH (latch_count): the field that is wrong
 */
keel_status_t keel_voter_check(const keel_voter_config_t *config);

/**
 * Makes a channel ready for its first vote (requirement VOT-002). A copy of the configuration is
 * kept.
 *
 * @param voter  the channel
 * @param config how it votes
 * @return KEEL_OK, or what keel_voter_check returns; the channel is not touched then
 */
keel_status_t keel_voter_init(keel_voter_t *voter, const keel_voter_config_t *config);

/**
 * Sets a for the next vote by the last output (requirement VOT-019): a = agree + slope |output|, at
 * most KEEL_VOTER_AGREE_MAX, and n a with it. Where n a would exceed KEEL_VOTER_RANGE, both are
 * those of the configuration.
 *
 * @param voter the channel, initialised
 */
void keel_voter_scale(keel_voter_t *voter);

/**
 * Takes one vote (requirements VOT-005 to VOT-013, VOT-020 to VOT-022). Its result is in
 * voter->vote.
 *
 * @param voter      the channel, initialised
 * @param sample     a sample per sensor, N of them, in the order of the sensors; any bit pattern
 * @param elapsed_us the time since the last vote, in us: how long a held output lasts
 */
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
keel_status_t keel_voter_readmit(keel_voter_t *voter, uint32_t sensor);

/**
 * Puts latched sensors on probation (requirement VOT-021), after a vote, with its samples: a sensor
 * is readmitted, as by keel_voter_readmit, after readmit_count calls in a row for which its sample
 * was usable, was not stale, and lay within a of the output of the vote, or the vote had none.
 *
 * @param voter  the channel, after a vote
 * @param sample the samples of that vote
 */
void keel_voter_reconsider(keel_voter_t *voter, const keel_voter_sample_t sample[]);

KEEL_C_END

#endif
