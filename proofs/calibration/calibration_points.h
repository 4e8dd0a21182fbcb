/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file calibration_points.h
 * @brief Chosen calibrations and samples: each way through a step, another number on each axis.
 */
#ifndef CALIBRATION_POINTS_H
#define CALIBRATION_POINTS_H

#include "calibration_proof.h"

#define REST_POINTS  14u
#define FIELD_POINTS 10u
#define SIDES_POINTS 12u
#define MEAN_POINTS  14u

/* A run of which three samples came; one is missing. */
static keel_calibration_rest_t known_rest(void)
{
    const keel_calibration_rest_t rest = {
        .config = {.expected = {1.0f, 2.0f, -10.0f}, .spread = 1.0f, .limit = 4.0f, .samples = 4u},
        .per_sample = 0.25f,
        .offset = {0.5f, -0.5f, 0.75f},
        .first = {2.0f, 4.0f, -9.0f},
        .sum = {1.0f, -1.0f, 0.5f},
        .count = 3u,
        .state = KEEL_CALIBRATION_COLLECTING,
        .restarts = 7u,
        .beyond = 0u,
    };

    return rest;
}

static void make_rest_point(unsigned point, keel_calibration_rest_t *rest,
                            keel_calibration_vector_t *sample)
{
    const keel_calibration_vector_t usual = {{2.5f, 3.25f, -9.5f}};

    *rest = known_rest();
    *sample = usual;
    switch (point) {
    case 1u:
        rest->count = 0u;
        break;
    case 2u:
        rest->count = 2u;
        break;
    case 3u:
        sample->axis[0] = 3.5f;
        break;
    case 4u:
        sample->axis[1] = 2.5f;
        break;
    case 5u:
        sample->axis[2] = LIMIT + 1.0f;
        break;
    case 6u:
        rest->config.expected[0] = -2.0f;
        break;
    case 7u:
        rest->config.expected[1] = -2.0f;
        break;
    case 8u:
        rest->config.expected[2] = -20.0f;
        break;
    case 9u:
        rest->state = KEEL_CALIBRATION_DONE;
        break;
    case 10u:
        rest->restarts = 65535u;
        sample->axis[2] = -7.5f;
        break;
    case 11u:
        rest->count = 0u;
        sample->axis[0] = 2.0f * LIMIT;
        break;
    case 12u:
        sample->axis[0] = 3.0f;
        sample->axis[1] = 3.0f;
        break;
    case 13u:
        rest->config.expected[0] = 6.5f;
        rest->config.expected[2] = -4.75f;
        break;
    default:
        break;
    }
}

/* A magnetometer that was turned about all axes. */
static keel_calibration_field_t known_field(void)
{
    const keel_calibration_field_t field = {
        .config = {.lowest = -400.0f,
                   .highest = 500.0f,
                   .span_min = 64.0f,
                   .span_max = 128.0f,
                   .limit = 50.0f},
        .offset = {1.0f, 2.0f, 3.0f},
        .lowest = {-40.0f, -30.0f, -80.0f},
        .highest = {40.0f, 60.0f, 20.0f},
        .state = KEEL_CALIBRATION_COLLECTING,
        .dropped = 3u,
    };

    return field;
}

static void make_field_point(unsigned point, keel_calibration_field_t *field)
{
    *field = known_field();
    switch (point) {
    case 1u:
        field->highest[0] = 23.0f;
        break;
    case 2u:
        field->highest[1] = 33.0f;
        break;
    case 3u:
        field->lowest[2] = -43.0f;
        break;
    case 4u:
        field->lowest[0] = -89.0f;
        break;
    case 5u:
        field->lowest[1] = 0.0f;
        field->highest[1] = 102.0f;
        break;
    case 6u:
        field->lowest[2] = -100.0f;
        field->highest[2] = -2.0f;
        break;
    case 7u:
        field->lowest[2] = -110.0f;
        field->highest[2] = -2.0f;
        break;
    case 8u:
        field->state = KEEL_CALIBRATION_IDLE;
        break;
    case 9u:
        field->highest[2] = 48.0f;
        break;
    default:
        break;
    }
}

/* An accelerometer that is off and out of scale, on each axis by another number. */
static keel_calibration_sides_t sides_point(unsigned point)
{
    keel_calibration_sides_t sides = {
        .up = {8.5f, 8.0f, 7.5f}, .down = {-8.0f, -8.25f, -7.25f}, .gravity = 8.0f, .limit = 0.25f};

    switch (point) {
    case 1u:
        sides.gravity = 0.0f;
        break;
    case 2u:
        sides.limit = -1.0f;
        break;
    case 3u:
        sides.up[0] = 9.0f; /* Too far off. */
        break;
    case 4u:
        sides.down[1] = -7.0f;
        break;
    case 5u:
        sides.up[2] = 8.5f;
        break;
    case 6u:
        sides.up[0] = 6.0f; /* Out of scale, but even. */
        sides.down[0] = -6.0f;
        break;
    case 7u:
        sides.up[1] = 12.0f;
        sides.down[1] = -12.0f;
        break;
    case 8u:
        sides.up[2] = 0.125f; /* The same on both sides. */
        sides.down[2] = 0.125f;
        break;
    case 9u:
        sides.up[2] = 2.0f * LIMIT;
        break;
    case 10u:
        sides.down[1] = -2.0f * LIMIT;
        break;
    case 11u:
        sides.gravity = 2.0f * LIMIT;
        break;
    default:
        break;
    }
    return sides;
}

/* For 6 at least and 1 at most: each side, at those ends, and what is just beyond. */
static keel_calibration_vector_t mean_point(unsigned point)
{
    static const keel_calibration_vector_t means[MEAN_POINTS] = {
        {{6.0f, 1.0f, -1.0f}},    {{-6.0f, -1.0f, 1.0f}},   {{1.0f, 9.0f, -1.0f}},
        {{-1.0f, -9.0f, 1.0f}},   {{1.0f, -1.0f, 8.0f}},    {{-1.0f, 1.0f, -8.0f}},
        {{5.5f, 0.0f, 0.0f}},     {{-5.5f, 0.0f, 0.0f}},    {{8.0f, 1.5f, 0.0f}},
        {{8.0f, 0.0f, -1.5f}},    {{1.5f, 8.0f, 0.0f}},     {{0.0f, 1.5f, -8.0f}},
        {{0.0f, 0.0f, 65536.0f}}, {{0.0f, -65536.0f, 0.0f}}};

    return means[point];
}

#endif
