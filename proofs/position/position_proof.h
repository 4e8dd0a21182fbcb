/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file position_proof.h
 * @brief What the harnesses of the position estimator share: arbitrary estimators, and when two are
 *        the same.
 */
#ifndef POSITION_PROOF_H
#define POSITION_PROOF_H

#include "../axis/axis_proof.h"
#include "keel/flight/position.h"

#include <stdbool.h>
#include <stdint.h>

int32_t nondet_s32(void);
keel_position_t nondet_position(void);
keel_position_config_t nondet_position_config(void);
keel_position_sample_t nondet_position_sample(void);

static bool position_config_same(const keel_position_config_t *a, const keel_position_config_t *b)
{
    return axis_config_same(&a->axis, &b->axis) && float_same(a->accuracy, b->accuracy) &&
           float_same(a->speed_accuracy, b->speed_accuracy);
}

static bool position_same(const keel_position_t *a, const keel_position_t *b)
{
    return position_config_same(&a->config, &b->config) && axis_same(&a->north, &b->north) &&
           axis_same(&a->east, &b->east) && (a->latitude == b->latitude) &&
           (a->longitude == b->longitude) && float_same(a->north_scale, b->north_scale) &&
           float_same(a->east_scale, b->east_scale) && (a->has_origin == b->has_origin) &&
           (a->quality == b->quality);
}

static bool position_fix_same(const keel_position_fix_t *a, const keel_position_fix_t *b)
{
    return (a->latitude == b->latitude) && (a->longitude == b->longitude) &&
           float_same(a->north, b->north) && float_same(a->east, b->east) &&
           float_same(a->accuracy, b->accuracy) &&
           float_same(a->speed_accuracy, b->speed_accuracy) && (a->is_valid == b->is_valid);
}

static bool position_sample_same(const keel_position_sample_t *a, const keel_position_sample_t *b)
{
    return position_fix_same(&a->fix, &b->fix) && float_same(a->north, b->north) &&
           float_same(a->east, b->east) && (a->has_fix == b->has_fix) &&
           (a->has_acceleration == b->has_acceleration);
}

/* Any estimator at all. */
static keel_position_t any_position_at_all(void)
{
    keel_position_t position = nondet_position();

    position.north = any_axis_at_all();
    position.east = any_axis_at_all();
    position.has_origin = nondet_bool();
    return position;
}

/* Any bit pattern for all that was measured. */
static keel_position_sample_t any_position_sample(void)
{
    keel_position_sample_t sample = nondet_position_sample();

    sample.fix.is_valid = nondet_bool();
    sample.has_fix = nondet_bool();
    sample.has_acceleration = nondet_bool();
    return sample;
}

static bool accuracies_valid(const keel_position_config_t *config)
{
    return within(config->accuracy, 0.0f, KEEL_POSITION_ACCURACY_LIMIT) &&
           within(config->speed_accuracy, 0.0f, KEEL_POSITION_SPEED_ACCURACY_LIMIT);
}

/* Metres per 1e-7 degrees, far from what would overflow. How long they are is tested: POS-004. */
static bool scales_valid(const keel_position_t *position)
{
    return within(position->north_scale, -1.0f, 1.0f) && within(position->east_scale, -1.0f, 1.0f);
}

/* What init establishes and all else keeps. */
static bool position_valid(const keel_position_t *position)
{
    return accuracies_valid(&position->config) && axis_valid(&position->north) &&
           axis_valid(&position->east) && scales_valid(position);
}

#endif
