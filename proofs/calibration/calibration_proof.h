/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file calibration_proof.h
 * @brief What the harnesses of calibrations share: arbitrary ones, when two are the same, and which
 *        are valid.
 */
#ifndef CALIBRATION_PROOF_H
#define CALIBRATION_PROOF_H

#include "../common/same.h"
#include "keel/flight/calibration.h"

#include <float.h>
#include <stdbool.h>

#define LIMIT KEEL_CALIBRATION_LIMIT

bool nondet_bool(void);
keel_calibration_rest_t nondet_rest(void);
keel_calibration_rest_config_t nondet_rest_config(void);
keel_calibration_field_t nondet_field(void);
keel_calibration_field_config_t nondet_field_config(void);

uint32_t nondet_uint32(void);

keel_calibration_vector_t nondet_vector(void);
keel_calibration_correction_t nondet_correction(void);
keel_calibration_sides_t nondet_sides(void);
keel_calibration_rotation_t nondet_turn(void);
float nondet_float(void);

static bool vector_same(const keel_calibration_vector_t *a, const keel_calibration_vector_t *b)
{
    return float_same(a->axis[0u], b->axis[0u]) && float_same(a->axis[1u], b->axis[1u]) &&
           float_same(a->axis[2u], b->axis[2u]);
}

static bool three_same(const float *a, const float *b)
{
    return float_same(a[0], b[0]) && float_same(a[1], b[1]) && float_same(a[2], b[2]);
}

static bool correction_same(const keel_calibration_correction_t *a,
                            const keel_calibration_correction_t *b)
{
    return float_same(a->offset[0u], b->offset[0u]) && float_same(a->offset[1u], b->offset[1u]) &&
           float_same(a->offset[2u], b->offset[2u]) && float_same(a->scale[0u], b->scale[0u]) &&
           float_same(a->scale[1u], b->scale[1u]) && float_same(a->scale[2u], b->scale[2u]);
}

static bool rest_config_same(const keel_calibration_rest_config_t *a,
                             const keel_calibration_rest_config_t *b)
{
    return float_same(a->spread, b->spread) && float_same(a->limit, b->limit) &&
           (a->samples == b->samples) && float_same(a->expected[0u], b->expected[0u]) &&
           float_same(a->expected[1u], b->expected[1u]) &&
           float_same(a->expected[2u], b->expected[2u]);
}

static bool rest_same(const keel_calibration_rest_t *a, const keel_calibration_rest_t *b)
{
    return rest_config_same(&a->config, &b->config) && float_same(a->per_sample, b->per_sample) &&
           (a->count == b->count) && (a->state == b->state) && (a->restarts == b->restarts) &&
           (a->beyond == b->beyond) && float_same(a->offset[0u], b->offset[0u]) &&
           float_same(a->offset[1u], b->offset[1u]) && float_same(a->offset[2u], b->offset[2u]) &&
           float_same(a->first[0u], b->first[0u]) && float_same(a->first[1u], b->first[1u]) &&
           float_same(a->first[2u], b->first[2u]) && float_same(a->sum[0u], b->sum[0u]) &&
           float_same(a->sum[1u], b->sum[1u]) && float_same(a->sum[2u], b->sum[2u]);
}

static bool field_config_same(const keel_calibration_field_config_t *a,
                              const keel_calibration_field_config_t *b)
{
    return float_same(a->lowest, b->lowest) && float_same(a->highest, b->highest) &&
           float_same(a->span_min, b->span_min) && float_same(a->span_max, b->span_max) &&
           float_same(a->limit, b->limit);
}

static bool field_same(const keel_calibration_field_t *a, const keel_calibration_field_t *b)
{
    return field_config_same(&a->config, &b->config) && (a->state == b->state) &&
           (a->dropped == b->dropped) && float_same(a->offset[0u], b->offset[0u]) &&
           float_same(a->offset[1u], b->offset[1u]) && float_same(a->offset[2u], b->offset[2u]) &&
           float_same(a->lowest[0u], b->lowest[0u]) && float_same(a->lowest[1u], b->lowest[1u]) &&
           float_same(a->lowest[2u], b->lowest[2u]) && float_same(a->highest[0u], b->highest[0u]) &&
           float_same(a->highest[1u], b->highest[1u]) && float_same(a->highest[2u], b->highest[2u]);
}

static bool within(float value, float least, float most)
{
    return (least <= value) && (value <= most);
}

static bool three_within(const float *value, float least, float most)
{
    return within(value[0], least, most) && within(value[1], least, most) &&
           within(value[2], least, most);
}

static bool is_finite(float value)
{
    return within(value, -FLT_MAX, FLT_MAX);
}

/* What the contracts of corrections ask for, or promise. */
static bool correction_valid(const keel_calibration_correction_t *c)
{
    return three_within(c->offset, -LIMIT, LIMIT) &&
           three_within(c->scale, KEEL_CALIBRATION_SCALE_MIN, KEEL_CALIBRATION_SCALE_MAX);
}

static bool side_limits(float least, float most)
{
    return within(least, 0.0f, LIMIT) && within(most, 0.0f, LIMIT) && (most < least);
}

static bool sides_fit_here(const keel_calibration_sides_t *s)
{
    return within(s->gravity, 0.0f, LIMIT) && (s->gravity > 0.0f) && within(s->limit, 0.0f, LIMIT);
}

static uint32_t any_axis(void)
{
    const uint32_t axis = nondet_uint32();

    __CPROVER_assume(axis < KEEL_CALIBRATION_AXES);
    return axis;
}

/* Any calibration at all. */
static keel_calibration_rest_t any_rest_at_all(void)
{
    return nondet_rest();
}

static keel_calibration_field_t any_field_at_all(void)
{
    return nondet_field();
}

static bool expected_fits(const keel_calibration_rest_config_t *c)
{
    return three_within(c->expected, -LIMIT, LIMIT);
}

static bool rest_limits(const keel_calibration_rest_config_t *c)
{
    return within(c->spread, 0.0f, LIMIT) && within(c->limit, 0.0f, LIMIT) && (c->samples >= 1u) &&
           (c->samples <= KEEL_CALIBRATION_SAMPLES_MAX);
}

/* What a step asks for. */
static bool rest_counts(const keel_calibration_rest_t *r)
{
    return is_finite(r->config.spread) && is_finite(r->config.limit) &&
           (r->count <= KEEL_CALIBRATION_SAMPLES_MAX);
}

/* A sum of differences is at most as many times the limit, exactly: that is a float, and what is
 * rounded does not pass it. */
static bool sum_valid(float sum, uint32_t count)
{
    return within(sum, -(float)count * LIMIT, (float)count * LIMIT);
}

/* What init establishes and every step keeps. */
static bool rest_valid(const keel_calibration_rest_t *r)
{
    const bool collects = r->state == KEEL_CALIBRATION_COLLECTING;

    return expected_fits(&r->config) && rest_limits(&r->config) &&
           within(r->per_sample, 0x1p-16f, 1.0f) &&
           three_within(r->offset, -r->config.limit, r->config.limit) &&
           three_within(r->first, -LIMIT, LIMIT) && (r->count <= r->config.samples) &&
           (!collects || (r->count < r->config.samples)) && (r->beyond <= 7u) &&
           ((r->state == KEEL_CALIBRATION_REFUSED) == (r->beyond != 0u)) &&
           (r->state <= KEEL_CALIBRATION_REFUSED) &&
           ((r->count == 0u) || (sum_valid(r->sum[0], r->count) && sum_valid(r->sum[1], r->count) &&
                                 sum_valid(r->sum[2], r->count))) &&
           three_within(r->sum, -0x1p31f, 0x1p31f);
}

static bool field_range(const keel_calibration_field_config_t *c)
{
    return within(c->highest, -LIMIT, LIMIT) && within(c->lowest, -LIMIT, c->highest);
}

static bool field_limits(const keel_calibration_field_config_t *c)
{
    return within(c->span_max, 0.0f, 2.0f * LIMIT) && within(c->span_min, 0.0f, c->span_max) &&
           (c->span_min > 0.0f) && within(c->limit, 0.0f, LIMIT);
}

/* What every function asks of a calibration of a magnetometer. */
static bool field_finite(const keel_calibration_field_config_t *c)
{
    return is_finite(c->lowest) && is_finite(c->highest) && is_finite(c->span_min) &&
           is_finite(c->span_max) && is_finite(c->limit);
}

static bool field_valid(const keel_calibration_field_t *f)
{
    const keel_calibration_field_config_t *const c = &f->config;

    return field_range(c) && field_limits(c) && three_within(f->offset, -c->limit, c->limit) &&
           three_within(f->lowest, c->lowest, c->highest) &&
           three_within(f->highest, c->lowest, c->highest) && (f->state <= KEEL_CALIBRATION_DONE);
}

static uint32_t up_to_end(uint16_t count)
{
    return (count < 65535u) ? (count + 1u) : 65535u;
}

#endif
