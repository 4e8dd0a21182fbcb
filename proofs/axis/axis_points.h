/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file axis_points.h
 * @brief Chosen axes and samples: each way through a step, with numbers that tell every part of it.
 */
#ifndef AXIS_POINTS_H
#define AXIS_POINTS_H

#include "axis_proof.h"

#define POINTS 25u

/* An axis that is known well, of which every number is another. */
static keel_axis_t known_axis(void)
{
    const keel_axis_t axis = {
        .config = {.rate_hz = 100.0f,
                   .position_gain = 0.25f,
                   .velocity_gain = 0.5f,
                   .rate_gain = 0.125f,
                   .bias_gain = 0.0625f,
                   .bias_limit = 0.75f,
                   .position_gate = 8.0f,
                   .velocity_gate = 4.0f,
                   .late_steps = 20u,
                   .lost_steps = 200u,
                   .settle_fixes = 5u,
                   .jump_fixes = 3u},
        .step = 0.01f,
        .half_step = 0.005f,
        .position = 10.0f,
        .velocity = 2.0f,
        .bias = 0.5f,
        .age = 10u,
        .agreed = 5u,
        .jump = 20.0f,
        .jumped = 1u,
        .flags = KEEL_AXIS_JUMPED,
        .quality = KEEL_AXIS_GOOD,
    };

    return axis;
}

static keel_axis_sample_t fixed_sample(void)
{
    const keel_axis_sample_t sample = {.acceleration = 3.0f,
                                       .position = 11.5f,
                                       .velocity = 3.0f,
                                       .has_acceleration = true,
                                       .has_fix = true,
                                       .has_velocity = true,
                                       .is_usable = true};

    return sample;
}

static void change_axis(unsigned point, keel_axis_t *axis)
{
    switch (point) {
    case 1u:
        axis->age = 200u;
        break;
    case 2u:
        axis->age = 199u;
        break;
    case 3u:
        axis->jumped = 2u;
        break;
    case 4u:
        axis->agreed = 2u;
        break;
    case 5u:
        axis->agreed = 4u;
        break;
    case 6u:
        axis->age = 18u;
        break;
    case 7u:
        axis->age = 19u;
        break;
    case 8u:
        axis->position = KEEL_AXIS_POSITION_LIMIT;
        axis->velocity = KEEL_AXIS_VELOCITY_LIMIT;
        break;
    case 9u:
        axis->bias = 0.75f;
        break;
    case 21u:
        axis->age = 200u;
        break;
    case 22u:
    case 23u:
        axis->jumped = 2u;
        break;
    case 24u:
        axis->jumped = 0u;
        break;
    default:
        break;
    }
}

static void change_sample(unsigned point, keel_axis_sample_t *sample)
{
    switch (point) {
    case 3u:
    case 10u:
        sample->position = 20.0f;
        break;
    case 6u:
    case 7u:
    case 8u:
    case 11u:
        sample->has_fix = false;
        break;
    case 9u:
        sample->position = 5.0f;
        break;
    case 12u:
        sample->velocity = -3.0f;
        break;
    case 13u:
        sample->has_velocity = false;
        break;
    case 14u:
        sample->is_usable = false;
        break;
    case 15u:
        sample->position = 2.0f * KEEL_AXIS_POSITION_LIMIT;
        break;
    case 16u:
        sample->velocity = 2.0f * KEEL_AXIS_VELOCITY_LIMIT;
        break;
    case 17u:
        sample->has_acceleration = false;
        break;
    case 18u:
        sample->acceleration = 2.0f * KEEL_AXIS_ACCELERATION_LIMIT;
        sample->has_fix = false;
        break;
    case 19u:
        sample->position = -20.0f;
        break;
    case 20u:
        sample->velocity = 1.0e3f;
        sample->has_velocity = false;
        break;
    case 21u:
        sample->has_fix = false;
        sample->is_usable = false;
        break;
    case 22u:
        sample->position = 28.0f;
        break;
    case 23u:
        sample->position = 28.015625f;
        break;
    case 24u:
        sample->position = 20.0f;
        break;
    default:
        break;
    }
}

static void make_point(unsigned point, keel_axis_t *axis, keel_axis_sample_t *sample)
{
    *axis = known_axis();
    *sample = fixed_sample();
    change_axis(point, axis);
    change_sample(point, sample);
}

#endif
