/**
 * @file voter_proof.h
 * @brief What the CBMC harnesses of the voter share: arbitrary configurations, channels, samples.
 */
#ifndef VOTER_PROOF_H
#define VOTER_PROOF_H

#include "keel/middleware/voter.h"

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
           (c->agree <= KEEL_VOTER_AGREE_MAX);
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
    return (s->null < c->latch_count) &&
           ((c->density_limit == 0u) || (s->density < c->density_limit));
}

/* n a of a valid configuration */
static bool none_valid_here(float agree, float none)
{
    return (agree < none) && (none <= KEEL_VOTER_RANGE);
}

static keel_voter_config_t any_voter_config(void)
{
    keel_voter_config_t c;

    c.agree = nondet_float();
    c.cutoff = nondet_float();
    c.lowest = nondet_float();
    c.highest = nondet_float();
    c.initial = nondet_float();
    c.max_age_us = nondet_u32();
    c.latch_count = nondet_u16();
    c.stale_count = nondet_u16();
    c.density_limit = nondet_u16();
    c.sensors = nondet_u8();
    return c;
}

static keel_voter_sensor_t any_sensor(void)
{
    keel_voter_sensor_t s;

    s.last = nondet_float();
    s.same = nondet_u16();
    s.null = nondet_u16();
    s.density = nondet_u16();
    s.latched = nondet_bool();
    return s;
}

static bool sensor_same(const keel_voter_sensor_t *a, const keel_voter_sensor_t *b)
{
    return (a->last == b->last) && (a->same == b->same) && (a->null == b->null) &&
           (a->density == b->density) && (a->latched == b->latched);
}

/* voter_unanimous */
static bool unanimous_here(const keel_voter_t *v)
{
    bool clean = true;
    bool above = false;
    bool below = false;

    for (uint32_t i = 0u; i < SENSORS; i++) {
        if (i < v->config.sensors) {
            const keel_voter_sensor_t *const s = &v->sensor[i];

            clean = clean && !s->latched && (s->same == 0u) && (s->null == 0u) &&
                    (s->density == 0u) && (v->vote.weight[i] == 1.0f) &&
                    (v->vote.reason[i] == KEEL_VOTER_USED) && (v->config.lowest <= s->last) &&
                    (s->last <= v->config.highest);
            above = above || (s->last <= v->vote.output);
            below = below || (v->vote.output <= s->last);
        }
    }
    return clean && above && below && (v->vote.state == KEEL_VOTER_MEAN) &&
           (v->vote.contributing == v->config.sensors) && (v->vote.held == 0u) &&
           (v->vote.held_us == 0u);
}

/* Any valid channel (voter_valid) with this a and n a. The cut-off n matters through n a only. */
static void any_voter(keel_voter_t *voter, float agree, float none)
{
    voter->config = any_voter_config();
    voter->config.agree = agree;
    __CPROVER_assume((2u <= voter->config.sensors) && (voter->config.sensors <= SENSORS));
    __CPROVER_assume(agreement_valid_here(&voter->config) && limits_valid_here(&voter->config));
    __CPROVER_assume((voter->config.max_age_us > 0u) && (voter->config.latch_count > 0u));
    voter->none = none;
    voter->vote.output = nondet_float();
    __CPROVER_assume((voter->config.lowest <= voter->vote.output) &&
                     (voter->vote.output <= voter->config.highest));
    voter->vote.held = nondet_u32();
    voter->vote.held_us = nondet_u32();
    voter->vote.state = nondet_u8();
    voter->vote.contributing = nondet_u8();
    for (uint32_t i = 0u; i < SENSORS; i++) {
        voter->sensor[i] = any_sensor();
        __CPROVER_assume(finite_here(voter->sensor[i].last));
        __CPROVER_assume(voter->sensor[i].latched ||
                         healthy_here(&voter->config, &voter->sensor[i]));
        voter->vote.weight[i] = nondet_float();
        voter->vote.reason[i] = nondet_u8();
    }
    voter->unanimous = nondet_bool();
    __CPROVER_assume(!voter->unanimous || unanimous_here(voter));
}

static void any_samples(keel_voter_sample_t sample[SENSORS])
{
    for (uint32_t i = 0u; i < SENSORS; i++) {
        sample[i].value = nondet_float();
        sample[i].age_us = nondet_u32();
        sample[i].present = nondet_bool();
    }
}

/* What a sample's reason must be, from the contract. */
static uint8_t reason_of(const keel_voter_config_t *config, const keel_voter_sensor_t *was,
                         uint16_t same, const keel_voter_sample_t *sample)
{
    if (was->latched) {
        return KEEL_VOTER_LATCHED;
    }
    if (!sample->present) {
        return KEEL_VOTER_MISSING;
    }
    if (!finite_here(sample->value)) {
        return KEEL_VOTER_NOT_FINITE;
    }
    if ((sample->value < config->lowest) || (config->highest < sample->value)) {
        return KEEL_VOTER_OUT_OF_RANGE;
    }
    if (config->max_age_us < sample->age_us) {
        return KEEL_VOTER_LATE;
    }
    if ((0u < config->stale_count) && (config->stale_count <= same)) {
        return KEEL_VOTER_STALE;
    }
    return KEEL_VOTER_USED;
}

#endif
