/* SPDX-License-Identifier: Apache-2.0 */
/* One axis of the cascade: whether it can be flown, and its step. */
#include "cascade.h"

#include "pid.h"

/* No comparison with NaN holds. */
static bool lies_within(float value, float least, float greatest)
{
    return (value >= least) && (value <= greatest);
}

/* The nearest number of a range; NaN has none. */
static float next_to(float value, float least, float greatest)
{
    const float above = (value > least) ? value : least;

    return (above < greatest) ? above : greatest;
}

/* CAS-001: the greatest reach of each axis. */
static float reach_limit(uint32_t axis)
{
    float limit;

    switch (axis) {
    case KEEL_CASCADE_ROLL_RATE:
    case KEEL_CASCADE_PITCH_RATE:
    case KEEL_CASCADE_YAW_RATE:
        limit = 64.0f;
        break;
    case KEEL_CASCADE_ROLL:
    case KEEL_CASCADE_PITCH:
        limit = 0.75f;
        break;
    case KEEL_CASCADE_NORTH_SPEED:
    case KEEL_CASCADE_EAST_SPEED:
    case KEEL_CASCADE_CLIMB:
        limit = 100.0f;
        break;
    default:
        limit = 16384.0f;
        break;
    }
    return limit;
}

static bool numbers_valid(const keel_cascade_config_t *config)
{
    return lies_within(config->hover, 0.0f, 1.0f) &&
           lies_within(config->acceleration, 0.25f, 64.0f) &&
           lies_within(config->braking, 0.25f, 64.0f) &&
           lies_within(config->reaction_s, 0.0f, 4.0f);
}

/* CAS-001: the tilt that an acceleration leads to is within both reaches, in total, and it brakes,
 * and does not accelerate, by what the fence counts on. */
static bool acceleration_valid(const keel_cascade_config_t *config, const keel_pid_config_t *pid)
{
    const float roll = config->reach[KEEL_CASCADE_ROLL];
    const float pitch = config->reach[KEEL_CASCADE_PITCH];
    const float most = KEEL_CASCADE_DIAGONAL * next_to((roll < pitch) ? roll : pitch, 0.0f, 0.75f);

    return (pid->output_min >= -most) && (pid->output_max <= most) &&
           (pid->output_max >= config->braking) && (pid->output_max <= config->acceleration) &&
           (pid->output_min <= -config->braking) && (pid->output_min >= -config->acceleration);
}

/* CAS-001: what is below takes each output. */
static bool output_valid(const keel_cascade_config_t *config, uint32_t axis)
{
    const keel_pid_config_t *const pid = &config->pid[axis];
    bool valid;

    switch (axis) {
    case KEEL_CASCADE_ROLL_RATE:
    case KEEL_CASCADE_PITCH_RATE:
    case KEEL_CASCADE_YAW_RATE:
        valid = (pid->output_min >= -1.0f) && (pid->output_max <= 1.0f);
        break;
    case KEEL_CASCADE_NORTH_SPEED:
    case KEEL_CASCADE_EAST_SPEED:
        valid = acceleration_valid(config, pid);
        break;
    case KEEL_CASCADE_CLIMB:
        valid = (pid->output_min >= -config->hover) && (pid->output_max <= (1.0f - config->hover));
        break;
    default:
        valid = (pid->output_min >= -config->reach[axis - 3u]) &&
                (pid->output_max <= config->reach[axis - 3u]);
        break;
    }
    return valid;
}

keel_status_t model_cascade_check(const keel_cascade_config_t *config, uint32_t axis)
{
    keel_pid_t made;

    if (axis >= KEEL_CASCADE_AXES) {
        return KEEL_ERR_INPUT;
    }
    if (!numbers_valid(config) || !lies_within(config->reach[axis], 0.0f, reach_limit(axis)) ||
        !output_valid(config, axis)) {
        return KEEL_ERR_LIMITS;
    }
    /* CAS-001: a period of the velocity stage is within the reaction time. */
    if ((axis >= KEEL_CASCADE_NORTH_SPEED) && (axis <= KEEL_CASCADE_CLIMB) &&
        !((config->reaction_s * config->pid[axis].rate_hz) >= 1.0f)) {
        return KEEL_ERR_LIMITS;
    }
    return model_pid_init(&made, &config->pid[axis]);
}

void model_cascade_axis_step(keel_cascade_axis_t *axis, const keel_cascade_input_t *input)
{
    const bool is_input = lies_within(input->setpoint, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT);
    const bool above = input->setpoint > axis->reach;
    const bool below = input->setpoint < -axis->reach;
    /* CAS-004: what is beyond the reach counts as that; what is no number is refused. */
    const float setpoint = is_input ? next_to(input->setpoint, -axis->reach, axis->reach)
                                    : input->setpoint;
    bool taken = false;

    /* CAS-007: an axis begins at what is flown. CAS-005: without a measurement it stops. */
    if (!input->valid) {
        axis->running = false;
    } else if (!axis->running) {
        axis->running = model_pid_enter(&axis->pid, setpoint, input->measured, input->flown) ==
                        KEEL_OK;
    } else {
        /* It runs already. */
    }
    /* CAS-006: the integral does not move to where what is below is at its limit. */
    if (axis->running) {
        taken = model_pid_step_within(&axis->pid, setpoint, input->measured, !input->below.at_max,
                                      !input->below.at_min) == KEEL_OK;
    }
    axis->held = !taken;
    axis->limit.at_max = input->below.at_max || above || (axis->pid.saturation == KEEL_PID_AT_MAX);
    axis->limit.at_min = input->below.at_min || below || (axis->pid.saturation == KEEL_PID_AT_MIN);
}
