/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis_proof.h
 * @brief What the harnesses of axes, and of what is made of them, share: arbitrary axes, when two
 *        are the same, and the contract of a step.
 */
#ifndef AXIS_PROOF_H
#define AXIS_PROOF_H

#include "../common/same.h"
#include "keel/flight/axis.h"

#include <float.h>
#include <stdbool.h>

bool nondet_bool(void);
keel_axis_t nondet_axis(void);
keel_axis_config_t nondet_axis_config(void);
keel_axis_sample_t nondet_axis_sample(void);

static bool axis_config_same(const keel_axis_config_t *a, const keel_axis_config_t *b)
{
    return float_same(a->rate_hz, b->rate_hz) && float_same(a->position_gain, b->position_gain) &&
           float_same(a->velocity_gain, b->velocity_gain) &&
           float_same(a->rate_gain, b->rate_gain) && float_same(a->bias_gain, b->bias_gain) &&
           float_same(a->bias_limit, b->bias_limit) &&
           float_same(a->position_gate, b->position_gate) &&
           float_same(a->velocity_gate, b->velocity_gate) && (a->late_steps == b->late_steps) &&
           (a->lost_steps == b->lost_steps) && (a->settle_fixes == b->settle_fixes) &&
           (a->jump_fixes == b->jump_fixes);
}

static bool axis_same(const keel_axis_t *a, const keel_axis_t *b)
{
    return axis_config_same(&a->config, &b->config) && float_same(a->step, b->step) &&
           float_same(a->half_step, b->half_step) && float_same(a->position, b->position) &&
           float_same(a->velocity, b->velocity) && float_same(a->bias, b->bias) &&
           float_same(a->jump, b->jump) && (a->age == b->age) && (a->agreed == b->agreed) &&
           (a->jumped == b->jumped) && (a->flags == b->flags) && (a->quality == b->quality);
}

static bool axis_sample_same(const keel_axis_sample_t *a, const keel_axis_sample_t *b)
{
    return float_same(a->acceleration, b->acceleration) && float_same(a->position, b->position) &&
           float_same(a->velocity, b->velocity) && (a->has_acceleration == b->has_acceleration) &&
           (a->has_fix == b->has_fix) && (a->has_velocity == b->has_velocity) &&
           (a->is_usable == b->is_usable);
}

static bool within(float value, float least, float most)
{
    return (least <= value) && (value <= most);
}

/* Any axis at all. */
static keel_axis_t any_axis_at_all(void)
{
    return nondet_axis();
}

/* Any bit pattern for all that was measured. */
static keel_axis_sample_t any_axis_sample(void)
{
    keel_axis_sample_t sample = nondet_axis_sample();

    sample.has_acceleration = nondet_bool();
    sample.has_fix = nondet_bool();
    sample.has_velocity = nondet_bool();
    sample.is_usable = nondet_bool();
    return sample;
}

static bool rate_fits(const keel_axis_config_t *c)
{
    return within(c->rate_hz, KEEL_AXIS_RATE_MIN_HZ, KEEL_AXIS_RATE_MAX_HZ);
}

static bool gains_fit(const keel_axis_config_t *c)
{
    return within(c->position_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
           within(c->velocity_gain, 0.0f, KEEL_AXIS_VELOCITY_GAIN_LIMIT) &&
           within(c->rate_gain, 0.0f, KEEL_AXIS_PART_LIMIT) &&
           within(c->bias_gain, 0.0f, KEEL_AXIS_BIAS_GAIN_LIMIT);
}

static bool axis_config_valid(const keel_axis_config_t *c)
{
    return rate_fits(c) && gains_fit(c) && within(c->bias_limit, 0.0f, KEEL_AXIS_BIAS_LIMIT) &&
           within(c->position_gate, 0.0f, KEEL_AXIS_POSITION_LIMIT) &&
           within(c->velocity_gate, 0.0f, KEEL_AXIS_VELOCITY_LIMIT) && (c->late_steps > 0u) &&
           (c->late_steps <= c->lost_steps) && (c->settle_fixes > 0u) && (c->jump_fixes > 0u);
}

/* What init establishes and every step keeps. */
static bool axis_valid(const keel_axis_t *axis)
{
    return axis_config_valid(&axis->config) && within(axis->step, 0.0009765625f, 0.125f) &&
           within(axis->half_step, 0.00048828125f, 0.0625f) &&
           within(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           within(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT) &&
           within(axis->bias, -axis->config.bias_limit, axis->config.bias_limit) &&
           within(axis->jump, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           (axis->age <= axis->config.lost_steps) && (axis->agreed <= axis->config.settle_fixes) &&
           (axis->jumped < axis->config.jump_fixes) && (axis->quality <= KEEL_AXIS_GOOD);
}

static bool is_told(const keel_axis_t *axis, uint32_t flag)
{
    return (axis->flags & flag) != 0u;
}

static bool counts(const keel_axis_sample_t *sample)
{
    return sample->has_fix && sample->is_usable &&
           within(sample->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           (!sample->has_velocity ||
            within(sample->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT));
}

/* The contract of keel_axis_step, for whoever calls it. */
static bool keel_axis_step_may(const keel_axis_t *axis)
{
    return within(axis->config.bias_limit, 0.0f, KEEL_AXIS_BIAS_LIMIT) &&
           within(axis->config.position_gate, -FLT_MAX, FLT_MAX) &&
           within(axis->config.velocity_gate, -FLT_MAX, FLT_MAX);
}

static bool keel_axis_step_does(const keel_axis_t *axis, const keel_axis_sample_t *sample)
{
    const bool taken = is_told(axis, KEEL_AXIS_FIXED) || is_told(axis, KEEL_AXIS_JUMPED);

    return within(axis->position, -KEEL_AXIS_POSITION_LIMIT, KEEL_AXIS_POSITION_LIMIT) &&
           within(axis->velocity, -KEEL_AXIS_VELOCITY_LIMIT, KEEL_AXIS_VELOCITY_LIMIT) &&
           (is_told(axis, KEEL_AXIS_UNUSABLE) == (sample->has_fix && !counts(sample))) &&
           (taken == counts(sample));
}

#endif
