/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file attitude_points.h
 * @brief Chosen estimators and samples: between them they reach all that a step does.
 */
#ifndef ATTITUDE_POINTS_H
#define ATTITUDE_POINTS_H

#include "attitude_proof.h"

#define POINTS 46u

/* Running, with a valid heading, in no special attitude; 1000 Hz. */
static const keel_attitude_t running = {.config = {.rate_hz = 1000.0f,
                                                   .tilt_gain = 0.5f,
                                                   .heading_gain = 0.25f,
                                                   .align_gain = 4.0f,
                                                   .bias_gain = 0.125f,
                                                   .force_gain = 2.0f,
                                                   .field_share = 0.25f,
                                                   .bias_limit = 0.0625f,
                                                   .quiet_rate = 0.5f,
                                                   .clip_rate = 32.0f,
                                                   .still_rate = 0.25f,
                                                   .still_acceleration = 0.5f,
                                                   .tolerance = 0.25f,
                                                   .north = 1.0f,
                                                   .still_steps = 3u,
                                                   .settle_steps = 3u,
                                                   .lost_steps = 3u,
                                                   .field_steps = 3u},
                                        .scale = {.step = 0.001f,
                                                  .half_step = 0.0005f,
                                                  .bias_step = 0.000125f,
                                                  .quiet = 0.25f,
                                                  .tolerance = 0.0625f,
                                                  .north = 1.0f,
                                                  .still = 0.33333334f},
                                        .quaternion = {0.9f, 0.1f, -0.2f, 0.374165739f},
                                        .bias = {0.01f, -0.02f, 0.03f},
                                        .gyroscope = {0.1f, 0.2f, -0.3f},
                                        .first_rate = {0.1f, 0.1f, 0.1f},
                                        .first_force = {2.9f, 3.2f, -8.7f},
                                        .sum = {0.01f, 0.02f, 0.03f},
                                        .down = {0.05f, -0.08f, 0.98f},
                                        .field = {0.9f, -0.3f, 0.4f},
                                        .heading_error = 0.2f,
                                        .still = 1u,
                                        .settled = 2u,
                                        .heading_settled = 2u,
                                        .field_age = 1u,
                                        .heading_valid = true,
                                        .phase = KEEL_ATTITUDE_RUNNING};

/* Near what that attitude would measure, and all of it. */
static const keel_attitude_sample_t measured = {.gyroscope = {0.11f, 0.12f, 0.07f},
                                                .accelerometer = {3.0f, 3.3f, -8.6f},
                                                .magnetometer = {0.6f, -0.8f, 0.3f},
                                                .acceleration = {0.4f, -0.7f, 0.2f},
                                                .has_gyroscope = true,
                                                .has_accelerometer = true,
                                                .has_magnetometer = true,
                                                .has_acceleration = true};

/* Level, northward, and nothing passes the low passes: what is compared equals its bound, or 0.
 */
static void make_limit(unsigned point, keel_attitude_t *attitude)
{
    static const keel_attitude_quaternion_t level = {1.0f, 0.0f, 0.0f, 0.0f};

    attitude->quaternion = level;
    attitude->config.force_gain = 0.0f;
    attitude->config.align_gain = 0.0f;
    attitude->config.field_share = 0.0f;
    attitude->down = (keel_attitude_vector_t){0.0f, 0.0f, 1.0f};
    attitude->field = (keel_attitude_vector_t){0.9f, 0.25f, 0.0f};
    switch (point) {
    case 32u: /* The heading's error is the tolerance: 1/4, whose square is 1/16. */
        attitude->heading_valid = false;
        attitude->settled = 1u;
        break;
    case 33u: /* It is more than that, and ahead; and less, and behind. */
        attitude->heading_valid = false;
        attitude->field.y = 0.5f;
        break;
    case 34u:
        attitude->heading_valid = false;
        attitude->scale.tolerance = 2.0f;
        attitude->field.x = -0.9f;
        break;
    case 35u: /* South, and a right angle off. */
        attitude->field.x = -0.9f;
        attitude->field.y = 0.0f;
        break;
    case 36u:
        attitude->field.x = 0.0f;
        attitude->field.y = 0.9f;
        break;
    case 37u: /* Down's error has the cosine 1/2. */
        attitude->down.x = 0.8f;
        attitude->down.z = 0.5f;
        break;
    case 38u: /* A right angle, which is within the tolerance. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->scale.tolerance = 2.0f;
        attitude->down.x = 1.0f;
        attitude->down.z = 0.0f;
        break;
    case 39u: /* Down's error is the tolerance. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->down.x = -0.25f;
        attitude->down.z = 0.96875f;
        break;
    case 40u: /* The least of gravity, and the most. */
        attitude->down = (keel_attitude_vector_t){0.375f, 0.125f, 0.75f};
        break;
    case 41u:
        attitude->down = (keel_attitude_vector_t){0.5625f, 0.0625f, 1.0f};
        break;
    case 42u: /* No field, though it is one. */
        attitude->field = (keel_attitude_vector_t){0.25f, 0.125f, 3.0f};
        break;
    case 43u: /* What turns along comes to its bounds. */
        attitude->scale.step = 1.0f;
        attitude->down = (keel_attitude_vector_t){16.0f, -16.0f, 16.0f};
        attitude->field = (keel_attitude_vector_t){4096.0f, -4096.0f, 4096.0f};
        break;
    case 44u: /* No more than the tolerance drives the bias. */
        attitude->scale.bias_step = 0.03125f;
        attitude->down = (keel_attitude_vector_t){0.5f, -0.375f, 0.875f};
        attitude->field = (keel_attitude_vector_t){0.5f, -0.75f, 0.0f};
        break;
    default: /* Quiet less its bias, and not with it. */
        attitude->bias = (keel_attitude_vector_t){0.0625f, 0.0f, 0.0f};
        attitude->gyroscope = (keel_attitude_vector_t){0.55f, 0.0f, 0.0f};
        attitude->down.x = 0.125f;
        break;
    }
}

/* One thing is different in each; the first is as it is. */
static void make_point(unsigned point, keel_attitude_t *attitude, keel_attitude_sample_t *sample)
{
    *attitude = running;
    *sample = measured;
    switch (point) {
    case 0u:
        break;
    case 1u: /* Lost, and held. */
        sample->has_gyroscope = false;
        break;
    case 2u: /* Lost once too often. */
        sample->has_gyroscope = false;
        attitude->lost = 2u;
        break;
    case 3u: /* Clipped. */
        sample->gyroscope.x = 33.0f;
        break;
    case 4u: /* A rate that cannot be. */
        sample->gyroscope.y = -41.0f;
        break;
    case 5u: /* A force that cannot be. */
        sample->accelerometer.x = 321.0f;
        break;
    case 6u: /* Too fast for the bias. */
        sample->gyroscope.z = 0.7f;
        break;
    case 7u: /* Upside down. */
        attitude->down.z = -0.95f;
        attitude->settled = 1u;
        break;
    case 8u: /* No gravity. */
        attitude->down.z = 0.3f;
        break;
    case 9u: /* The bias at its limit. */
        attitude->bias.x = 0.0625f;
        attitude->bias.y = -0.0625f;
        attitude->bias.z = 0.0625f;
        attitude->scale.bias_step = 1.0f;
        break;
    case 10u: /* The field from behind, or away. */
        attitude->field.x = -0.9f;
        sample->has_acceleration = false;
        break;
    case 11u:
        sample->has_magnetometer = false;
        attitude->field_age = 2u;
        break;
    case 12u: /* Aligning, at the end of it. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->heading_valid = false;
        break;
    case 13u: /* Still, at the end of it; and moved. */
        attitude->phase = KEEL_ATTITUDE_STILL;
        attitude->still = 2u;
        attitude->config.bias_limit = 0.5f;
        break;
    case 14u:
        attitude->phase = KEEL_ATTITUDE_STILL;
        sample->accelerometer.x = 3.6f;
        break;
    case 15u: /* No quaternion. */
        attitude->quaternion.w = 0.5f;
        break;
    case 16u: /* Aligning, and near, while a lost rate is still counted. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->lost = 2u;
        break;
    case 17u: /* The heading becomes valid; not when its error is large. */
        attitude->heading_valid = false;
        attitude->field.y = -0.1f;
        sample->magnetometer.x = 0.2f;
        break;
    case 18u:
        attitude->heading_valid = false;
        attitude->config.north = 0.0f;
        attitude->scale.north = 0.0f;
        attitude->scale.east = 1.0f;
        break;
    case 19u: /* A field that is none. */
        sample->magnetometer.x = 4097.0f;
        break;
    case 20u: /* Still, but the mean rate is too large for a bias. */
        attitude->phase = KEEL_ATTITUDE_STILL;
        attitude->still = 2u;
        break;
    case 21u: /* Not still: no rate. */
        attitude->phase = KEEL_ATTITUDE_STILL;
        sample->has_gyroscope = false;
        break;
    case 22u: /* Not still: no force that can be one. */
        attitude->phase = KEEL_ATTITUDE_STILL;
        sample->accelerometer.y = 321.0f;
        break;
    case 23u: /* Aligning, without quaternion, accelerometer and field. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->quaternion.w = 0.5f;
        attitude->lost = 2u;
        sample->has_gyroscope = false;
        sample->has_accelerometer = false;
        sample->has_magnetometer = false;
        break;
    case 24u: /* An acceleration that is none. */
        sample->acceleration.z = 321.0f;
        break;
    case 25u: /* Not still: no force; the first of the samples; a turn. */
        attitude->phase = KEEL_ATTITUDE_STILL;
        sample->has_accelerometer = false;
        break;
    case 26u:
        attitude->phase = KEEL_ATTITUDE_STILL;
        attitude->still = 0u;
        break;
    case 27u:
        attitude->phase = KEEL_ATTITUDE_STILL;
        sample->gyroscope.y = 0.5f;
        break;
    case 28u: /* Aligning, upside down; and far off. */
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->down.z = -0.95f;
        break;
    case 29u:
        attitude->phase = KEEL_ATTITUDE_ALIGNING;
        attitude->down = (keel_attitude_vector_t){0.6f, 0.6f, 0.5f};
        break;
    case 30u: /* Sums whose rounding tells their order. */
        sample->acceleration.x = 3.7f;
        sample->acceleration.y = -1.3f;
        sample->acceleration.z = 0.86f;
        break;
    case 31u:
        sample->acceleration.x = 3.7f;
        sample->acceleration.y = -1.3f;
        sample->acceleration.z = 0.27f;
        break;
    case 45u: /* Quiet, but for the bias. */
        sample->gyroscope = (keel_attitude_vector_t){0.55f, 0.0f, 0.0f};
        make_limit(point, attitude);
        break;
    default:
        make_limit(point, attitude);
        break;
    }
}

#endif
