/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cascades.h
 * @brief A cascade for tests.
 */
#ifndef KEEL_TESTS_UNIT_CASCADES_H
#define KEEL_TESTS_UNIT_CASCADES_H

#include "keel/flight/cascade.h"
#include "keel/flight/mode.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define AXES KEEL_CASCADE_AXES

static keel_cascade_config_t config;
static keel_cascade_t cascade;

static keel_pid_config_t controller(float kp, float ki, float rate_hz, float least, float most)
{
    const keel_pid_config_t pid = {.gains = {kp, ki, 0.0f, 0.0f},
                                   .rate_hz = rate_hz,
                                   .cutoff_hz = 0.125f * rate_hz,
                                   .output_min = least,
                                   .output_max = most,
                                   .integral_min = 2.0f * least,
                                   .integral_max = 2.0f * most};

    return pid;
}

/* Numbers that are exact, and all different; each integral moves by a quarter of its error. */
static void configure(void)
{
    static const float reach[AXES] = {6.0f, 5.0f, 3.0f,  0.5f,  0.75f, 8.0f,
                                      7.0f, 4.0f, 90.0f, 80.0f, 70.0f};

    memset(&config, 0, sizeof config);
    memcpy(config.reach, reach, sizeof reach);
    config.pid[KEEL_CASCADE_ROLL_RATE] = controller(0.125f, 256.0f, 1024.0f, -0.75f, 1.0f);
    config.pid[KEEL_CASCADE_PITCH_RATE] = controller(0.25f, 256.0f, 1024.0f, -1.0f, 0.875f);
    config.pid[KEEL_CASCADE_YAW_RATE] = controller(0.5f, 256.0f, 1024.0f, -0.5f, 0.5f);
    config.pid[KEEL_CASCADE_ROLL] = controller(8.0f, 128.0f, 512.0f, -5.0f, 6.0f);
    config.pid[KEEL_CASCADE_PITCH] = controller(6.0f, 128.0f, 512.0f, -5.0f, 4.0f);
    config.pid[KEEL_CASCADE_NORTH_SPEED] = controller(1.5f, 32.0f, 128.0f, -3.0f, 3.25f);
    config.pid[KEEL_CASCADE_EAST_SPEED] = controller(1.25f, 32.0f, 128.0f, -3.25f, 3.0f);
    config.pid[KEEL_CASCADE_CLIMB] = controller(0.125f, 32.0f, 128.0f, -0.25f, 0.5f);
    config.pid[KEEL_CASCADE_NORTH] = controller(0.75f, 16.0f, 64.0f, -8.0f, 7.5f);
    config.pid[KEEL_CASCADE_EAST] = controller(0.5f, 16.0f, 64.0f, -7.0f, 6.0f);
    config.pid[KEEL_CASCADE_HEIGHT] = controller(1.0f, 16.0f, 64.0f, -3.0f, 4.0f);
    config.hover = 0.375f;
    config.acceleration = 4.0f;
    config.braking = 2.5f;
    config.reaction_s = 0.25f;
}

#endif
