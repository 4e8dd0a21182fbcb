/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file cascade_proof.h
 * @brief What the harnesses of the cascade share: arbitrary cascades, and when two are the same.
 */
#ifndef CASCADE_PROOF_H
#define CASCADE_PROOF_H

#include "../../specs/model/cascade.h"
#include "../common/pid_contracts.h"
#include "keel/middleware/range.h"

#define AXES KEEL_CASCADE_AXES

unsigned int nondet_uint(void);
keel_cascade_t nondet_cascade(void);
keel_cascade_axis_t nondet_axis(void);
keel_cascade_input_t nondet_input(void);
keel_cascade_config_t nondet_cascade_config(void);
keel_cascade_estimate_t nondet_estimate(void);
keel_cascade_rates_t nondet_rates(void);
keel_cascade_tilt_t nondet_tilt(void);
keel_cascade_vector_t nondet_cascade_vector(void);
keel_attitude_vector_t nondet_vector(void);

static bool limit_same(const keel_cascade_limit_t *a, const keel_cascade_limit_t *b)
{
    return (a->at_min == b->at_min) && (a->at_max == b->at_max);
}

static bool axis_same(const keel_cascade_axis_t *a, const keel_cascade_axis_t *b)
{
    return pid_same(&a->pid, &b->pid) && float_same(a->reach, b->reach) &&
           limit_same(&a->limit, &b->limit) && (a->running == b->running) && (a->held == b->held);
}

static bool input_same(const keel_cascade_input_t *a, const keel_cascade_input_t *b)
{
    return float_same(a->setpoint, b->setpoint) && float_same(a->measured, b->measured) &&
           float_same(a->flown, b->flown) && limit_same(&a->below, &b->below) &&
           (a->valid == b->valid);
}

static bool fence_same(const keel_cascade_fence_t *a, const keel_cascade_fence_t *b)
{
    return float_same(a->gain, b->gain) && float_same(a->half_gain, b->half_gain) &&
           float_same(a->reaction_s, b->reaction_s) &&
           float_same(a->twice_braking, b->twice_braking);
}

static bool cascade_vector_same(const keel_cascade_vector_t *a, const keel_cascade_vector_t *b)
{
    return float_same(a->north, b->north) && float_same(a->east, b->east) &&
           float_same(a->up, b->up);
}

static bool tilt_same(const keel_cascade_tilt_t *a, const keel_cascade_tilt_t *b)
{
    return float_same(a->roll, b->roll) && float_same(a->pitch, b->pitch);
}

static bool command_same(const keel_mixer_command_t *a, const keel_mixer_command_t *b)
{
    return float_same(a->roll, b->roll) && float_same(a->pitch, b->pitch) &&
           float_same(a->yaw, b->yaw) && float_same(a->thrust, b->thrust);
}

static bool cascade_same(const keel_cascade_t *a, const keel_cascade_t *b)
{
    return fence_same(&a->fence, &b->fence) && float_same(a->hover, b->hover) &&
           (a->axes == b->axes) && (a->gave_way == b->gave_way) &&
           cascade_vector_same(&a->velocity, &b->velocity) && tilt_same(&a->tilt, &b->tilt) &&
           float_same(a->thrust, b->thrust) && tilt_same(&a->rates, &b->rates) &&
           command_same(&a->command, &b->command) && axis_same(&a->axis[0u], &b->axis[0u]) &&
           axis_same(&a->axis[1u], &b->axis[1u]) && axis_same(&a->axis[2u], &b->axis[2u]) &&
           axis_same(&a->axis[3u], &b->axis[3u]) && axis_same(&a->axis[4u], &b->axis[4u]) &&
           axis_same(&a->axis[5u], &b->axis[5u]) && axis_same(&a->axis[6u], &b->axis[6u]) &&
           axis_same(&a->axis[7u], &b->axis[7u]) && axis_same(&a->axis[8u], &b->axis[8u]) &&
           axis_same(&a->axis[9u], &b->axis[9u]) && axis_same(&a->axis[10u], &b->axis[10u]);
}

static bool estimate_same(const keel_cascade_estimate_t *a, const keel_cascade_estimate_t *b)
{
    return cascade_vector_same(&a->position, &b->position) &&
           cascade_vector_same(&a->velocity, &b->velocity) &&
           float_same(a->forward_north, b->forward_north) &&
           float_same(a->forward_east, b->forward_east) && (a->has_place == b->has_place) &&
           (a->has_height == b->has_height);
}

static bool axis_valid_here(const keel_cascade_axis_t *axis)
{
    return pid_valid_here(&axis->pid) && within(axis->reach, 0.0f, KEEL_CASCADE_DISTANCE_MAX);
}

static bool asks_within(const keel_cascade_axis_t *axis, float most)
{
    return (axis->pid.config.output_min >= -most) && (axis->pid.config.output_max <= most);
}

static bool command_valid_here(const keel_mixer_command_t *c)
{
    return magnitude(c->roll, 1.0f) && magnitude(c->pitch, 1.0f) && magnitude(c->yaw, 1.0f) &&
           within(c->thrust, 0.0f, 1.0f);
}

static bool fence_valid_here(const keel_cascade_fence_t *fence)
{
    return within(fence->gain, 0.0f, 256.0f) && within(fence->half_gain, 0.0f, 256.0f) &&
           within(fence->reaction_s, 0.0f, KEEL_CASCADE_REACTION_MAX_S) &&
           within(fence->twice_braking, 0.0f, 128.0f);
}

/* cascade_valid, but for the fence. */
static bool axes_valid_here(const keel_cascade_t *c)
{
    bool valid = within(c->hover, 0.0f, 1.0f) && command_valid_here(&c->command);

    for (uint32_t i = 0u; i < AXES; i++) {
        const float most = (i <= KEEL_CASCADE_YAW_RATE) ? 1.0f
                           : (i == KEEL_CASCADE_CLIMB)  ? 1.0f
                           : ((i == KEEL_CASCADE_NORTH_SPEED) || (i == KEEL_CASCADE_EAST_SPEED))
                               ? KEEL_CASCADE_GRAVITY
                               : c->axis[i - 3u].reach;

        valid = valid && axis_valid_here(&c->axis[i]) && asks_within(&c->axis[i], most);
    }
    return valid;
}

/* cascade_valid. */
static bool cascade_valid_here(const keel_cascade_t *c)
{
    return fence_valid_here(&c->fence) && axes_valid_here(c);
}

static keel_cascade_limit_t any_limit(void)
{
    return (keel_cascade_limit_t){nondet_bool(), nondet_bool()};
}

/* Any axis at all; flags are true or false. */
static keel_cascade_axis_t any_axis(void)
{
    keel_cascade_axis_t axis = nondet_axis();

    axis.pid = any_pid_at_all();
    axis.limit = any_limit();
    axis.running = nondet_bool();
    axis.held = nondet_bool();
    return axis;
}

static void any_cascade(keel_cascade_t *cascade)
{
    *cascade = nondet_cascade();
    for (uint32_t i = 0u; i < AXES; i++) {
        cascade->axis[i] = any_axis();
    }
}

static keel_cascade_input_t any_input(void)
{
    keel_cascade_input_t input = nondet_input();

    input.below = any_limit();
    input.valid = nondet_bool();
    return input;
}

static keel_cascade_estimate_t any_estimate(void)
{
    keel_cascade_estimate_t estimate = nondet_estimate();

    estimate.has_place = nondet_bool();
    estimate.has_height = nondet_bool();
    return estimate;
}

/* --- The contract of keel_cascade_check ------------------------------------------------------- */

static bool keel_cascade_check_may(void)
{
    return true;
}

/* What the axis of a configuration may ask for, of those that cascade_valid bounds. */
static float most_asked(const keel_cascade_config_t *config, uint32_t axis)
{
    return (axis <= KEEL_CASCADE_YAW_RATE) ? 1.0f
           : (axis == KEEL_CASCADE_CLIMB)  ? 1.0f
           : ((axis == KEEL_CASCADE_NORTH_SPEED) || (axis == KEEL_CASCADE_EAST_SPEED))
               ? KEEL_CASCADE_GRAVITY
               : config->reach[axis - 3u];
}

static float reach_of(uint32_t axis)
{
    return (axis <= KEEL_CASCADE_YAW_RATE) ? KEEL_CASCADE_RATE_MAX
           : (axis <= KEEL_CASCADE_PITCH)  ? KEEL_CASCADE_TILT_MAX
           : (axis <= KEEL_CASCADE_CLIMB)  ? KEEL_CASCADE_SPEED_MAX
                                           : KEEL_CASCADE_DISTANCE_MAX;
}

static bool keel_cascade_check_does(keel_status_t status, const keel_cascade_config_t *config,
                                    uint32_t axis)
{
    return (status != KEEL_OK) ||
           ((axis < AXES) && within(config->reach[axis], 0.0f, reach_of(axis)) &&
            limits_here(&config->pid[axis]) &&
            (config->pid[axis].output_min >= -most_asked(config, axis)) &&
            (config->pid[axis].output_max <= most_asked(config, axis)) &&
            within(config->hover, 0.0f, 1.0f) &&
            within(config->acceleration, KEEL_CASCADE_BRAKING_MIN, KEEL_CASCADE_ACCELERATION_MAX) &&
            within(config->braking, KEEL_CASCADE_BRAKING_MIN, KEEL_CASCADE_ACCELERATION_MAX) &&
            within(config->reaction_s, 0.0f, KEEL_CASCADE_REACTION_MAX_S));
}

/* --- The contract of keel_cascade_axis_step --------------------------------------------------- */

static bool keel_cascade_axis_step_may(const keel_cascade_axis_t *axis)
{
    return axis_valid_here(axis);
}

static bool keel_cascade_axis_step_does(const keel_cascade_axis_t *axis,
                                        const keel_cascade_axis_t *before,
                                        const keel_cascade_input_t *input)
{
    const bool taken = axis->running &&
                       float_same(axis->pid.setpoint,
                                  keel_range_clamp(input->setpoint, -axis->reach, axis->reach));

    return axis_valid_here(axis) && float_same(axis->reach, before->reach) &&
           pid_made_as_before(&axis->pid, &before->pid) && (axis->held || taken) &&
           (!axis->running || input->valid);
}

#endif
