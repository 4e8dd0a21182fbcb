/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cascade_points.h
 * @brief A configuration that can be flown, for harnesses with chosen numbers.
 */
#ifndef CASCADE_POINTS_H
#define CASCADE_POINTS_H

#include "cascade_proof.h"

static keel_pid_config_t pid_of(float kp, float ki, float rate_hz, float least, float most)
{
    const keel_pid_config_t config = {.gains = {kp, ki, 0.01f, 0.25f},
                                      .rate_hz = rate_hz,
                                      .cutoff_hz = 0.125f * rate_hz,
                                      .output_min = least,
                                      .output_max = most,
                                      .integral_min = (ki > 0.0f) ? least : 0.0f,
                                      .integral_max = (ki > 0.0f) ? most : 0.0f};

    return config;
}

static void good_config(keel_cascade_config_t *config)
{
    const float reach[AXES] = {6.0f, 5.0f, 3.0f, 0.5f, 0.5f, 8.0f, 7.0f, 4.0f, 90.0f, 80.0f, 70.0f};

    for (uint32_t i = 0u; i < AXES; i++) {
        config->reach[i] = reach[i];
    }
    config->pid[0] = pid_of(0.15f, 0.3f, 1000.0f, -0.75f, 0.75f);
    config->pid[1] = pid_of(0.17f, 0.2f, 1000.0f, -1.0f, 1.0f);
    config->pid[2] = pid_of(0.3f, 0.1f, 1000.0f, -0.5f, 0.5f);
    config->pid[3] = pid_of(7.0f, 0.5f, 500.0f, -5.0f, 6.0f);
    config->pid[4] = pid_of(6.0f, 0.0f, 500.0f, -5.0f, 4.0f);
    config->pid[5] = pid_of(1.5f, 0.4f, 100.0f, -3.0f, 3.25f);
    config->pid[6] = pid_of(1.6f, 0.3f, 100.0f, -3.25f, 3.0f);
    config->pid[7] = pid_of(0.2f, 0.1f, 100.0f, -0.25f, 0.5f);
    config->pid[8] = pid_of(0.8f, 0.1f, 50.0f, -8.0f, 8.0f);
    config->pid[9] = pid_of(0.9f, 0.0f, 50.0f, -7.0f, 6.0f);
    config->pid[10] = pid_of(1.1f, 0.2f, 50.0f, -3.0f, 4.0f);
    config->hover = 0.375f;
    config->acceleration = 4.0f;
    config->braking = 2.5f;
    config->reaction_s = 0.25f;
}

#endif
