/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file attitude_proof.h
 * @brief What the harnesses of the attitude estimator share: arbitrary estimators, and when two are
 *        the same.
 */
#ifndef ATTITUDE_PROOF_H
#define ATTITUDE_PROOF_H

#include "../common/same.h"
#include "keel/internal/flight/attitude.h"

#include <stdbool.h>

/* Of a unit quaternion, as |q|^2 is computed. */
#define COMPONENT_LIMIT 0x1.004p+0f

bool nondet_bool(void);
float nondet_float(void);
keel_attitude_t nondet_attitude(void);
keel_attitude_config_t nondet_attitude_config(void);
keel_attitude_sample_t nondet_attitude_sample(void);

static bool vector_same(const keel_attitude_vector_t *a, const keel_attitude_vector_t *b)
{
    return float_same(a->x, b->x) && float_same(a->y, b->y) && float_same(a->z, b->z);
}

static bool quaternion_same(const keel_attitude_quaternion_t *a,
                            const keel_attitude_quaternion_t *b)
{
    return float_same(a->w, b->w) && float_same(a->x, b->x) && float_same(a->y, b->y) &&
           float_same(a->z, b->z);
}

static bool attitude_config_same(const keel_attitude_config_t *a, const keel_attitude_config_t *b)
{
    return float_same(a->rate_hz, b->rate_hz) && float_same(a->tilt_gain, b->tilt_gain) &&
           float_same(a->heading_gain, b->heading_gain) &&
           float_same(a->align_gain, b->align_gain) && float_same(a->bias_gain, b->bias_gain) &&
           float_same(a->bias_limit, b->bias_limit) && float_same(a->quiet_rate, b->quiet_rate) &&
           float_same(a->force_gain, b->force_gain) && float_same(a->field_share, b->field_share) &&
           float_same(a->clip_rate, b->clip_rate) && float_same(a->still_rate, b->still_rate) &&
           float_same(a->still_acceleration, b->still_acceleration) &&
           float_same(a->tolerance, b->tolerance) && float_same(a->north, b->north) &&
           float_same(a->east, b->east) && (a->still_steps == b->still_steps) &&
           (a->settle_steps == b->settle_steps) && (a->lost_steps == b->lost_steps) &&
           (a->field_steps == b->field_steps);
}

static bool attitude_scale_same(const keel_attitude_scale_t *a, const keel_attitude_scale_t *b)
{
    return float_same(a->step, b->step) && float_same(a->half_step, b->half_step) &&
           float_same(a->bias_step, b->bias_step) && float_same(a->quiet, b->quiet) &&
           float_same(a->tolerance, b->tolerance) && float_same(a->north, b->north) &&
           float_same(a->east, b->east) && float_same(a->still, b->still);
}

static bool attitude_counts_same(const keel_attitude_t *a, const keel_attitude_t *b)
{
    return (a->still == b->still) && (a->settled == b->settled) &&
           (a->heading_settled == b->heading_settled) && (a->lost == b->lost) &&
           (a->field_age == b->field_age) && (a->flags == b->flags) &&
           (a->heading_valid == b->heading_valid) && (a->phase == b->phase);
}

static bool attitude_same(const keel_attitude_t *a, const keel_attitude_t *b)
{
    return attitude_config_same(&a->config, &b->config) &&
           attitude_scale_same(&a->scale, &b->scale) &&
           quaternion_same(&a->quaternion, &b->quaternion) && vector_same(&a->bias, &b->bias) &&
           vector_same(&a->rate, &b->rate) && vector_same(&a->gyroscope, &b->gyroscope) &&
           vector_same(&a->first_rate, &b->first_rate) &&
           vector_same(&a->first_force, &b->first_force) && vector_same(&a->sum, &b->sum) &&
           vector_same(&a->down, &b->down) && vector_same(&a->field, &b->field) &&
           float_same(a->heading_error, b->heading_error) && attitude_counts_same(a, b);
}

static bool sample_same(const keel_attitude_sample_t *a, const keel_attitude_sample_t *b)
{
    return vector_same(&a->gyroscope, &b->gyroscope) &&
           vector_same(&a->accelerometer, &b->accelerometer) &&
           vector_same(&a->magnetometer, &b->magnetometer) &&
           vector_same(&a->acceleration, &b->acceleration) &&
           (a->has_gyroscope == b->has_gyroscope) &&
           (a->has_accelerometer == b->has_accelerometer) &&
           (a->has_magnetometer == b->has_magnetometer) &&
           (a->has_acceleration == b->has_acceleration);
}

static bool within(float value, float least, float most)
{
    return (least <= value) && (value <= most);
}

static bool vector_within(keel_attitude_vector_t v, float most)
{
    return within(v.x, -most, most) && within(v.y, -most, most) && within(v.z, -most, most);
}

/* The contract of keel_attitude_is_unit: any quaternion; those that it takes for one are finite,
 * and within 1 + 2^-10 in each component. */
static bool keel_attitude_is_unit_may(void)
{
    return true;
}

static bool keel_attitude_is_unit_does(bool is_unit, keel_attitude_quaternion_t q)
{
    return !is_unit || (within(q.w, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
                        within(q.x, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
                        within(q.y, -COMPONENT_LIMIT, COMPONENT_LIMIT) &&
                        within(q.z, -COMPONENT_LIMIT, COMPONENT_LIMIT));
}

static bool attitude_config_valid(const keel_attitude_config_t *c)
{
    return within(c->rate_hz, KEEL_ATTITUDE_RATE_MIN_HZ, KEEL_ATTITUDE_RATE_MAX_HZ) &&
           within(c->tilt_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->heading_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->align_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->bias_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->force_gain, 0.0f, KEEL_ATTITUDE_GAIN_LIMIT) &&
           within(c->field_share, 0.0f, 1.0f) &&
           within(c->bias_limit, 0.0f, KEEL_ATTITUDE_BIAS_LIMIT) &&
           within(c->clip_rate, 0.0f, KEEL_ATTITUDE_RATE_LIMIT) &&
           within(c->quiet_rate, 0.0f, c->clip_rate) &&
           within(c->still_rate, 0.0f, KEEL_ATTITUDE_STILL_RATE_LIMIT) &&
           within(c->still_acceleration, 0.0f, KEEL_ATTITUDE_STILL_ACCELERATION_LIMIT) &&
           within(c->tolerance, 0.0f, 1.0f) && (c->still_steps > 0u) && (c->settle_steps > 0u) &&
           (c->lost_steps > 0u) && (c->field_steps > 0u);
}

static const keel_attitude_quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};

static bool is_level(keel_attitude_quaternion_t q)
{
    return quaternion_same(&q, &level);
}

static bool attitude_counts_valid(const keel_attitude_t *a)
{
    return (a->still < a->config.still_steps) && (a->settled <= a->config.settle_steps) &&
           (a->heading_settled <= a->config.settle_steps) && (a->lost <= a->config.lost_steps) &&
           (a->field_age <= a->config.field_steps) && (a->phase <= KEEL_ATTITUDE_RUNNING);
}

/* What init computes. A part of the expected field over its square is at most 1000 / 0.0625^2. */
static bool attitude_scale_valid(const keel_attitude_scale_t *s)
{
    return within(s->step, 0.0f, 0.002f) && within(s->half_step, 0.0f, 0.001f) &&
           within(s->bias_step, 0.0f, 0.016f) && within(s->quiet, 0.0f, 1600.0f) &&
           within(s->tolerance, 0.0f, 1.0f) && within(s->north, -256000.0f, 256000.0f) &&
           within(s->east, -256000.0f, 256000.0f) && within(s->still, 0.0f, 1.0f);
}

static bool attitude_still_valid(const keel_attitude_t *a)
{
    return vector_within(a->first_rate, KEEL_ATTITUDE_RATE_LIMIT) &&
           vector_within(a->first_force, KEEL_ATTITUDE_FORCE_LIMIT);
}

/* What was low-passed. */
static bool attitude_passed_valid(const keel_attitude_t *a)
{
    return vector_within(a->down, KEEL_ATTITUDE_DOWN_REACH) &&
           vector_within(a->field, KEEL_ATTITUDE_FIELD_REACH);
}

/* What init establishes and every step keeps, but for the quaternion. The heading's error is a sine
 * times the root of KEEL_ATTITUDE_FIELD_RATIO_MAX at most. */
static bool attitude_rest_valid(const keel_attitude_t *a)
{
    return attitude_config_valid(&a->config) && vector_within(a->bias, a->config.bias_limit) &&
           vector_within(a->gyroscope, KEEL_ATTITUDE_RATE_LIMIT) && attitude_still_valid(a) &&
           attitude_passed_valid(a) && within(a->heading_error, -1.25f, 1.25f) &&
           attitude_counts_valid(a);
}

/* What a step leaves: the level quaternion, or the last one that was taken for a unit. */
static keel_attitude_quaternion_t accepted;

bool keel_attitude_is_unit_stand_in(keel_attitude_quaternion_t q)
{
    const bool is_unit = nondet_bool();

    __CPROVER_assert(keel_attitude_is_unit_may(), "precondition: keel_attitude_is_unit");
    __CPROVER_assume(keel_attitude_is_unit_does(is_unit, q));
    accepted = is_unit ? q : level;
    return is_unit;
}

/* Any estimator at all. A flag is true or false. */
static keel_attitude_t any_attitude_at_all(void)
{
    keel_attitude_t attitude = nondet_attitude();

    attitude.heading_valid = nondet_bool();
    return attitude;
}

/* Any bit pattern for all that was measured. */
static keel_attitude_sample_t any_sample(void)
{
    keel_attitude_sample_t sample = nondet_attitude_sample();

    sample.has_gyroscope = nondet_bool();
    sample.has_accelerometer = nondet_bool();
    sample.has_magnetometer = nondet_bool();
    sample.has_acceleration = nondet_bool();
    return sample;
}

#endif
