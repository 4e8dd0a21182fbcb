/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file sticks.h
 * @brief A reference generator for tests, and the set-points that sticks come to.
 */
#ifndef KEEL_TESTS_UNIT_STICKS_H
#define KEEL_TESTS_UNIT_STICKS_H

#include "keel/flight/reference.h"
#include "unity.h"

#include <string.h>

static keel_reference_config_t config;
static keel_reference_t reference;

/* Four curves and eight limits, all different. */
static void configure(void)
{
    memset(&reference, 0x55, sizeof reference);
    config = (keel_reference_config_t){.roll = {0.5f, 0.0f},
                                       .pitch = {0.25f, 1.0f},
                                       .yaw = {0.125f, 0.5f},
                                       .climb = {0.0625f, 0.25f},
                                       .limits = {.roll_rate = 2.0f,
                                                  .pitch_rate = 3.0f,
                                                  .yaw_rate = 5.0f,
                                                  .heading_rate = 7.0f,
                                                  .tilt = 0.5f,
                                                  .speed = 11.0f,
                                                  .climb_rate = 13.0f,
                                                  .descent_rate = 17.0f}};
}

/* The next float away from 0; of 0 the smallest. */
static float farther(float value)
{
    uint32_t bits;

    memcpy(&bits, &value, sizeof bits);
    bits++;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static void make(void)
{
    TEST_ASSERT_EQUAL(KEEL_OK, keel_reference_init(&reference, &config));
}

static keel_reference_setpoints_t at(float roll, float pitch, float yaw, float climb)
{
    const keel_reference_sticks_t sticks = {roll, pitch, yaw, climb};

    TEST_ASSERT_EQUAL(KEEL_OK, keel_reference_step(&reference, &sticks));
    return reference.setpoints;
}

#endif
