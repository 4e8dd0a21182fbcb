/**
 * @file voter_vote.h
 * @brief What a whole vote must be, whatever the channel and the samples were.
 */
#ifndef VOTER_VOTE_H
#define VOTER_VOTE_H

#include "voter_proof.h"

static uint32_t one_up(uint32_t value, uint32_t most)
{
    return (value < most) ? (value + 1u) : most;
}

static void check_counts(const keel_voter_config_t *config, const keel_voter_sensor_t *was,
                         const keel_voter_sensor_t *is, uint8_t reason, uint32_t usable)
{
    const bool used = reason == KEEL_VOTER_USED;
    const bool condemned = (reason >= KEEL_VOTER_MISSING) ||
                           ((reason == KEEL_VOTER_OUTVOTED) && (usable > 2u));

    __CPROVER_assert(!used || (is->null == 0u), "VOT_010_clear: an agreement clears the count");
    __CPROVER_assert(!condemned || (is->null == one_up(was->null, UINT16_MAX)),
                     "VOT_010_condemned: a condemning vote is counted");
    __CPROVER_assert(condemned || used ||
                         ((is->null == was->null) && (is->density == was->density)),
                     "VOT_010_count: any other neither counts nor clears");
    __CPROVER_assert(is->latched ==
                         ((is->null >= config->latch_count) ||
                          ((config->density_limit > 0u) && (is->density >= config->density_limit))),
                     "VOT_011_latch: latched at a limit, and only then");
    __CPROVER_assert(!condemned || (is->density == one_up(was->density, UINT16_MAX)),
                     "VOT_012_fill: the leaky count rises");
    __CPROVER_assert(!used || (is->density == ((was->density > 0u) ? (was->density - 1) : 0)),
                     "VOT_012_density: and leaks");
}

/* What the samples are before anybody votes on them. */
typedef struct facts {
    bool readable[SENSORS];
    bool changed[SENSORS];
    uint32_t readables;
    uint32_t changes;
} facts_t;

static facts_t facts_of(const keel_voter_t *before, const keel_voter_sample_t sample[SENSORS])
{
    facts_t facts = {{false}, {false}, 0u, 0u};

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (i < before->config.sensors) {
            facts.readable[i] = !before->sensor[i].latched && sample[i].present &&
                                finite_here(sample[i].value);
            facts.changed[i] = facts.readable[i] && (sample[i].value != before->sensor[i].last);
            facts.readables += facts.readable[i] ? 1u : 0u;
            facts.changes += facts.changed[i] ? 1u : 0u;
        }
    }
    return facts;
}

static void check_change(const facts_t *facts, uint32_t i, const keel_voter_sensor_t *was,
                         const keel_voter_sensor_t *is, float value)
{
    const bool alone = facts->readable[i] && !facts->changed[i] && (facts->changes > 0u) &&
                       ((facts->changes + 1u) == facts->readables);

    __CPROVER_assert(is->last == (facts->changed[i] ? value : was->last),
                     "VOT_013_last: the last finite sample is kept");
    __CPROVER_assert(is->same == (facts->changed[i] ? 0u
                                  : alone           ? one_up(was->same, UINT16_MAX)
                                                    : was->same),
                     "VOT_013_stale: counted when it alone did not change");
}

static void check_output(const keel_voter_t *voter, const keel_voter_t *before,
                         const keel_voter_sample_t sample[SENSORS], uint32_t usable,
                         uint32_t elapsed_us)
{
    const keel_vote_t *const vote = &voter->vote;
    const bool held = vote->state >= KEEL_VOTER_DISAGREE;
    bool above = false;
    bool below = false;
    uint32_t contributing = 0u;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if ((i < voter->config.sensors) && (vote->reason[i] == KEEL_VOTER_USED)) {
            contributing++;
            above = above || (sample[i].value <= vote->output);
            below = below || (vote->output <= sample[i].value);
            __CPROVER_assert((vote->state != KEEL_VOTER_SINGLE) ||
                                 (vote->output == sample[i].value),
                             "VOT_009_single: the only usable sample is the output");
        }
    }
    __CPROVER_assert(vote->contributing == contributing, "VOT_006_contributing: counted");
    __CPROVER_assert(finite_here(vote->output) && (voter->config.lowest <= vote->output) &&
                         (vote->output <= voter->config.highest),
                     "VOT_005_valid: the output is finite and plausible");
    __CPROVER_assert(held || (above && below),
                     "VOT_005_hull: it lies among the samples that contributed");
    __CPROVER_assert(held == (contributing == 0u), "VOT_008_when: held when nothing contributes");
    __CPROVER_assert((vote->state == KEEL_VOTER_NONE) == (usable == 0u),
                     "VOT_008_none: nothing is usable");
    __CPROVER_assert((vote->state == KEEL_VOTER_SINGLE) == (usable == 1u),
                     "VOT_009_state: one usable sample");
    __CPROVER_assert(vote->state <= KEEL_VOTER_NONE, "VOT_008_state: there is no other");
    __CPROVER_assert(!held || (vote->output == before->vote.output),
                     "VOT_008_hold: the output is held");
    __CPROVER_assert(vote->held == (held ? one_up(before->vote.held, UINT32_MAX) : 0u),
                     "VOT_008_held: votes without an output are counted");
    __CPROVER_assert(vote->held_us == (!held ? 0u
                                       : (before->vote.held_us > (UINT32_MAX - elapsed_us))
                                           ? UINT32_MAX
                                           : (before->vote.held_us + elapsed_us)),
                     "VOT_008_held_us: and their time");
}

/* Whether all samples had weight 1, and nothing is counted against any sensor. */
static bool all_agreed(const keel_voter_t *voter)
{
    bool agreed = true;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        agreed = agreed && ((i >= voter->config.sensors) ||
                            ((voter->vote.weight[i] == 1.0f) && (voter->sensor[i].same == 0u) &&
                             (voter->sensor[i].null == 0u) && (voter->sensor[i].density == 0u)));
    }
    return agreed;
}

static void check_vote(const keel_voter_t *voter, const keel_voter_t *before, const facts_t *facts,
                       const keel_voter_sample_t sample[SENSORS], uint32_t elapsed_us)
{
    uint32_t usables = 0u;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        usables += ((i < voter->config.sensors) && (voter->vote.reason[i] <= KEEL_VOTER_OUTVOTED))
                       ? 1u
                       : 0u;
    }
    for (uint32_t i = 0u; i < SENSORS; i++) {
        const keel_voter_sensor_t *const was = &before->sensor[i];
        const keel_voter_sensor_t *const is = &voter->sensor[i];
        const uint8_t reason = voter->vote.reason[i];
        const float weight = voter->vote.weight[i];

        if (i < voter->config.sensors) {
            __CPROVER_assert(((reason == KEEL_VOTER_OUTVOTED) ? KEEL_VOTER_USED : reason) ==
                                 reason_of(&voter->config, was, is->same, &sample[i]),
                             "VOT_007_reason: the reason is the first that applies");
            __CPROVER_assert((weight >= 0.0f) && (weight <= 1.0f),
                             "VOT_006_weights: weights lie in [0, 1]");
            __CPROVER_assert((weight > 0.0f) == (reason == KEEL_VOTER_USED),
                             "VOT_006_reason: a weight of 0 has a reason, another has none");
            check_change(facts, i, was, is, sample[i].value);
            if (was->latched) {
                __CPROVER_assert(is->latched && (is->null == was->null) &&
                                     (is->density == was->density),
                                 "VOT_011_stays: a latched one stays so");
            } else {
                check_counts(&voter->config, was, is, reason, usables);
            }
        } else {
            __CPROVER_assert(sensor_same(was, is), "VOT_011_frame: no other slot is touched");
            __CPROVER_assert((reason == before->vote.reason[i]),
                             "VOT_007_frame: nor has it a reason");
        }
        __CPROVER_assert(is->latched || healthy_here(&voter->config, is),
                         "VOT_005_healthy: below its counts, or latched");
    }
    check_output(voter, before, sample, usables, elapsed_us);
    __CPROVER_assert(voter->unanimous == all_agreed(voter),
                     "VOT_018_next: whether the next vote may be taken for less");
    __CPROVER_assert(!voter->unanimous || unanimous_here(voter),
                     "VOT_018_valid: nothing is counted then");
    __CPROVER_assert((voter->none == before->none) &&
                         (voter->config.agree == before->config.agree) &&
                         (voter->config.sensors == before->config.sensors),
                     "VOT_005_config: the configuration stays");
}

#endif
