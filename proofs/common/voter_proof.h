/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file voter_proof.h
 * @brief What the CBMC harnesses of the voter share: arbitrary configurations, channels, samples.
 */
#ifndef VOTER_PROOF_H
#define VOTER_PROOF_H

#include "../../specs/model/voter.h"
#include "keel/internal/middleware/voter.h"
#include "same.h"

#include <stdbool.h>
#include <stdint.h>

#define SENSORS KEEL_VOTER_SENSORS

bool nondet_bool(void);
uint8_t nondet_u8(void);
uint16_t nondet_u16(void);
uint32_t nondet_u32(void);
float nondet_float(void); /* Any bit pattern. */

static bool finite_here(float x)
{
    return (-0x1.fffffep+127f <= x) && (x <= 0x1.fffffep+127f);
}

static bool agreement_valid_here(const keel_voter_config_t *c)
{
    return finite_here(c->agree) && (KEEL_VOTER_AGREE_MIN <= c->agree) &&
           (c->agree <= KEEL_VOTER_AGREE_MAX) && (0.0f <= c->slope) && (c->slope <= 1.0f);
}

static bool limits_valid_here(const keel_voter_config_t *c)
{
    return finite_here(c->lowest) && finite_here(c->highest) && (-KEEL_VOTER_RANGE <= c->lowest) &&
           (c->lowest <= c->highest) && (c->highest <= KEEL_VOTER_RANGE);
}

static bool initial_valid_here(const keel_voter_config_t *c)
{
    return finite_here(c->initial) && (c->lowest <= c->initial) && (c->initial <= c->highest);
}

/* voter_healthy */
static bool healthy_here(const keel_voter_config_t *c, const keel_voter_sensor_t *s)
{
    return (s->condemned_votes < c->latch_count) &&
           ((c->density_limit == 0u) || (s->density < c->density_limit));
}

/* n a of a valid configuration */
static bool disagree_valid_here(float agree, float disagree)
{
    return (agree < disagree) && (disagree <= KEEL_VOTER_RANGE);
}

/* voter_config_valid */
static bool config_valid_here(const keel_voter_config_t *c)
{
    return (2u <= c->sensors) && (c->sensors <= SENSORS) && agreement_valid_here(c) &&
           (1.0f < c->cutoff) && (c->cutoff <= (KEEL_VOTER_RANGE / KEEL_VOTER_AGREE_MIN)) &&
           disagree_valid_here(c->agree, c->cutoff * c->agree) && limits_valid_here(c) &&
           initial_valid_here(c) && (c->max_age_us > 0u) && (c->latch_count > 0u);
}

static keel_voter_config_t any_voter_config(void)
{
    keel_voter_config_t c;

    c.agree = nondet_float();
    c.cutoff = nondet_float();
    c.slope = nondet_float();
    c.lowest = nondet_float();
    c.highest = nondet_float();
    c.initial = nondet_float();
    c.max_age_us = nondet_u32();
    c.latch_count = nondet_u16();
    c.stale_count = nondet_u16();
    c.readmit_count = nondet_u16();
    c.density_limit = nondet_u16();
    c.sensors = nondet_u8();
    return c;
}

static keel_voter_sensor_t any_sensor(void)
{
    keel_voter_sensor_t s;

    s.last = nondet_float();
    s.unchanged_votes = nondet_u16();
    s.condemned_votes = nondet_u16();
    s.density = nondet_u16();
    s.probation = nondet_u16();
    s.latched = nondet_bool();
    return s;
}

static bool voter_config_same(const keel_voter_config_t *a, const keel_voter_config_t *b)
{
    return float_same(a->agree, b->agree) && float_same(a->cutoff, b->cutoff) &&
           float_same(a->slope, b->slope) && float_same(a->lowest, b->lowest) &&
           float_same(a->highest, b->highest) && float_same(a->initial, b->initial) &&
           (a->max_age_us == b->max_age_us) && (a->latch_count == b->latch_count) &&
           (a->stale_count == b->stale_count) && (a->readmit_count == b->readmit_count) &&
           (a->density_limit == b->density_limit) && (a->sensors == b->sensors);
}

static bool voter_sensor_same(const keel_voter_sensor_t *a, const keel_voter_sensor_t *b)
{
    return float_same(a->last, b->last) && (a->unchanged_votes == b->unchanged_votes) &&
           (a->probation == b->probation) && (a->condemned_votes == b->condemned_votes) &&
           (a->density == b->density) && (a->latched == b->latched);
}

static bool vote_same(const keel_vote_t *a, const keel_vote_t *b, uint32_t i)
{
    return float_same(a->output, b->output) && (a->held == b->held) && (a->held_us == b->held_us) &&
           (a->state == b->state) && (a->contributing == b->contributing) &&
           float_same(a->weight[i], b->weight[i]) && (a->reason[i] == b->reason[i]);
}

static bool voter_same(const keel_voter_t *a, const keel_voter_t *b, uint32_t i)
{
    return voter_config_same(&a->config, &b->config) && float_same(a->agree, b->agree) &&
           float_same(a->disagree, b->disagree) && vote_same(&a->vote, &b->vote, i) &&
           (a->unanimous == b->unanimous) && voter_sensor_same(&a->sensor[i], &b->sensor[i]);
}

static bool voter_sample_same(const keel_voter_sample_t *a, const keel_voter_sample_t *b)
{
    return float_same(a->value, b->value) && (a->age_us == b->age_us) && (a->present == b->present);
}

/* voter_unanimous */
static bool unanimous_here(const keel_voter_t *v)
{
    bool clean = true;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (i < v->config.sensors) {
            const keel_voter_sensor_t *const s = &v->sensor[i];

            clean = clean && !s->latched && (s->unchanged_votes == 0u) &&
                    (s->condemned_votes == 0u) && (s->density == 0u) &&
                    (v->vote.weight[i] == 1.0f) && (v->vote.reason[i] == KEEL_VOTER_USED);
        }
    }
    return clean && (v->vote.state == KEEL_VOTER_MEAN) &&
           (v->vote.contributing == v->config.sensors) && (v->vote.held == 0u) &&
           (v->vote.held_us == 0u);
}

/* Any channel with this a and n a; voter_valid_here tells whether it is valid. */
static void any_voter(keel_voter_t *voter, float agree, float disagree)
{
    voter->config = any_voter_config();
    voter->agree = agree;
    voter->disagree = disagree;
    voter->vote.output = nondet_float();
    voter->vote.held = nondet_u32();
    voter->vote.held_us = nondet_u32();
    voter->vote.state = nondet_u8();
    voter->vote.contributing = nondet_u8();
    voter->unanimous = nondet_bool();
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter->sensor[i] = any_sensor();
        voter->vote.weight[i] = nondet_float();
        voter->vote.reason[i] = nondet_u8();
    }
}

/* Any samples, and a copy of them. */
static void any_samples(keel_voter_sample_t sample[SENSORS], keel_voter_sample_t copy[SENSORS])
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].value = nondet_float();
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
        copy[i] = sample[i];
    }
}

#endif
