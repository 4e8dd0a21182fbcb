/**
 * @file voter_unanimous.h
 * @brief What an attempt at a unanimous vote must be, whatever the channel and the samples were.
 */
#ifndef VOTER_UNANIMOUS_H
#define VOTER_UNANIMOUS_H

#include "voter_stand_ins.h"

/* What the samples are before the vote. */
typedef struct facts {
    float least;
    float most;
    uint32_t plausible;
    uint32_t resting;
} facts_t;

static facts_t facts_of(const keel_voter_t *voter, const keel_voter_sample_t sample[SENSORS])
{
    facts_t facts = {sample[0].value, sample[0].value, 0u, 0u};

    for (uint32_t i = 0u; i < SENSORS; i++) {
        const float value = sample[i].value;

        if ((i < voter->config.sensors) && (voter->config.lowest <= value) &&
            (value <= voter->config.highest)) {
            facts.plausible++;
            facts.resting += (value == voter->sensor[i].last) ? 1u : 0u;
        }
        if ((0u < i) && (i < voter->config.sensors)) {
            facts.least = (facts.least > value) ? value : facts.least;
            facts.most = (facts.most > value) ? facts.most : value;
        }
    }
    return facts;
}

/* All but the last samples and the output. */
static void check_frame(const keel_voter_t *is, const keel_voter_t *was)
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        keel_voter_sensor_t expected = was->sensor[i];

        expected.last = is->sensor[i].last;
        __CPROVER_assert(voter_sensor_same(&is->sensor[i], &expected),
                         "VOT_018_counts: no count moves");
        __CPROVER_assert(float_same(is->vote.weight[i], was->vote.weight[i]) &&
                             (is->vote.reason[i] == was->vote.reason[i]),
                         "VOT_018_weights: nor weight or reason");
    }
    __CPROVER_assert((is->vote.state == was->vote.state) && (is->vote.held == was->vote.held) &&
                         (is->vote.held_us == was->vote.held_us) &&
                         (is->vote.contributing == was->vote.contributing) &&
                         (is->unanimous == was->unanimous) &&
                         (is->config.sensors == was->config.sensors),
                     "VOT_018_frame: nor what the vote says besides");
}

static void check_attempt(bool taken, const keel_voter_t *voter, const keel_voter_t *before,
                          const facts_t *facts, const keel_voter_sample_t sample[SENSORS],
                          uint32_t oldest_us)
{
    const bool plausible = before->unanimous && (oldest_us <= before->config.max_age_us) &&
                           (facts->plausible == before->config.sensors);
    const bool together = plausible &&
                          ((facts->resting == 0u) || (facts->resting == before->config.sensors));

    __CPROVER_assert(!together ||
                         ((stand_in_least == facts->least) && (stand_in_most == facts->most) &&
                          (stand_in_agree == before->config.agree)),
                     "VOT_018_within: the smallest and the largest are compared");
    __CPROVER_assert(taken == (together && stand_in_within),
                     "VOT_018_taken: taken just when it is unanimous");
    for (uint32_t i = 0u; i < SENSORS; i++) {
        const bool stored = taken && (i < before->config.sensors);

        __CPROVER_assert(voter->sensor[i].last ==
                             (stored ? sample[i].value : before->sensor[i].last),
                         "VOT_018_last: the samples are kept, if so");
    }
    __CPROVER_assert(taken || (voter->vote.output == before->vote.output),
                     "VOT_018_refused: else the output stays");
    __CPROVER_assert(!taken || ((facts->least <= voter->vote.output) &&
                                (voter->vote.output <= facts->most)),
                     "VOT_018_hull: it lies among the samples");
    __CPROVER_assert(!voter->unanimous || unanimous_here(voter),
                     "VOT_018_valid: nothing is counted, before and after");
    check_frame(voter, before);
}

#endif
