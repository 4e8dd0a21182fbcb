/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file mixer_proof.h
 * @brief What the harnesses of the mixer share: any valid mixer, and what is the same.
 */
#ifndef MIXER_PROOF_H
#define MIXER_PROOF_H

#include "../../specs/model/mixer.h"
#include "../common/same.h"

#include <stdbool.h>

bool nondet_bool(void);
uint32_t nondet_u32(void);
float nondet_float(void);
keel_mixer_t nondet_mixer(void);
keel_mixer_config_t nondet_config(void);
keel_mixer_command_t nondet_command(void);

static bool between(float value, float least, float greatest)
{
    return (least <= value) && (value <= greatest);
}

/* mixer_geometry, mixer_range */
static bool config_valid_here(const keel_mixer_config_t *config)
{
    bool valid = (config->geometry.motors >= KEEL_MIXER_MOTORS_MIN) &&
                 (config->geometry.motors <= KEEL_MIXER_MOTORS) &&
                 between(config->idle, KEEL_MIXER_IDLE_MIN, KEEL_MIXER_IDLE_MAX) &&
                 between(config->highest, KEEL_MIXER_HIGHEST_MIN, 1.0f) &&
                 between(config->yaw_share, 0.0f, KEEL_MIXER_YAW_SHARE_MAX);

    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        const keel_mixer_motor_t *const motor = &config->geometry.motor[i];

        valid = valid && ((i >= config->geometry.motors) ||
                          (between(motor->roll, -1.0f, 1.0f) &&
                           between(motor->pitch, -1.0f, 1.0f) && between(motor->yaw, -1.0f, 1.0f)));
    }
    return valid;
}

/* mixer_valid */
static bool mixer_valid_here(const keel_mixer_t *mixer)
{
    bool valid = config_valid_here(&mixer->config);

    for (uint32_t i = 0u; i < KEEL_MIXER_MOTORS; i++) {
        valid = valid && ((i < mixer->config.geometry.motors) || (mixer->output[i] == 0.0f));
    }
    return valid;
}

static bool motor_same(const keel_mixer_motor_t *x, const keel_mixer_motor_t *y)
{
    return float_same(x->roll, y->roll) && float_same(x->pitch, y->pitch) &&
           float_same(x->yaw, y->yaw);
}

static bool geometry_same(const keel_mixer_geometry_t *x, const keel_mixer_geometry_t *y)
{
    return (x->motors == y->motors) && motor_same(&x->motor[0u], &y->motor[0u]) &&
           motor_same(&x->motor[1u], &y->motor[1u]) && motor_same(&x->motor[2u], &y->motor[2u]) &&
           motor_same(&x->motor[3u], &y->motor[3u]) && motor_same(&x->motor[4u], &y->motor[4u]) &&
           motor_same(&x->motor[5u], &y->motor[5u]) && motor_same(&x->motor[6u], &y->motor[6u]) &&
           motor_same(&x->motor[7u], &y->motor[7u]);
}

static bool config_same(const keel_mixer_config_t *x, const keel_mixer_config_t *y)
{
    return geometry_same(&x->geometry, &y->geometry) && float_same(x->idle, y->idle) &&
           float_same(x->highest, y->highest) && float_same(x->yaw_share, y->yaw_share);
}

static bool mixer_same(const keel_mixer_t *x, const keel_mixer_t *y)
{
    return config_same(&x->config, &y->config) && (x->limited == y->limited) &&
           float_same(x->output[0u], y->output[0u]) && float_same(x->output[1u], y->output[1u]) &&
           float_same(x->output[2u], y->output[2u]) && float_same(x->output[3u], y->output[3u]) &&
           float_same(x->output[4u], y->output[4u]) && float_same(x->output[5u], y->output[5u]) &&
           float_same(x->output[6u], y->output[6u]) && float_same(x->output[7u], y->output[7u]);
}

/* A valid mixer of four motors, each with other factors, that was put to use before. */
static keel_mixer_t four_motors(float idle)
{
    keel_mixer_t mixer = {.config = {.geometry = {.motors = 4u}, .idle = idle, .highest = 0.93f},
                          .output = {0.1f, 0.2f, 0.3f, 0.4f},
                          .limited = 31u};

    for (uint32_t i = 0u; i < 4u; i++) {
        mixer.config.geometry.motor[i].roll = ((i == 0u) || (i == 1u)) ? -0.9f : 0.8f;
        mixer.config.geometry.motor[i].pitch = ((i == 0u) || (i == 3u)) ? 1.0f : -0.7f;
        mixer.config.geometry.motor[i].yaw = ((i % 2u) == 0u) ? 0.6f : -0.5f;
    }
    return mixer;
}

#endif
