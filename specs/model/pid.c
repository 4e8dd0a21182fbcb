/* SPDX-License-Identifier: Apache-2.0 */
#include "pid.h"

#include "filter.h"

/* No comparison with NaN holds. */
static bool contains(float value, float least, float greatest)
{
    return (value >= least) && (value <= greatest);
}

static float clamped(float value, float least, float greatest)
{
    const float above = (value > least) ? value : least;

    return (above < greatest) ? above : greatest;
}

static bool gains_valid(const keel_pid_gains_t *gains)
{
    return contains(gains->kp, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           contains(gains->ki, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           contains(gains->kd, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           contains(gains->kff, 0.0f, KEEL_PID_GAIN_LIMIT);
}

static bool limit_valid(float value)
{
    return contains(value, -KEEL_PID_OUTPUT_LIMIT, KEEL_PID_OUTPUT_LIMIT);
}

static bool limits_valid(const keel_pid_config_t *config)
{
    return limit_valid(config->output_min) && limit_valid(config->output_max) &&
           (config->output_min < config->output_max) && limit_valid(config->integral_min) &&
           limit_valid(config->integral_max) &&
           contains(0.0f, config->integral_min, config->integral_max);
}

static bool input_valid(float value)
{
    return contains(value, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT);
}

/* PID-008: what eq. 4 adds up but for the integral. */
static float without_integral(const keel_pid_gains_t *gains, float setpoint, float error,
                              float derivative)
{
    return ((gains->kp * error) + (gains->kff * setpoint)) + (gains->kd * derivative);
}

keel_status_t model_pid_init(keel_pid_t *pid, const keel_pid_config_t *config)
{
    keel_filter_t filter;
    keel_status_t status;

    /* PID-001: a refusal changes nothing. */
    if (!gains_valid(&config->gains)) {
        return KEEL_ERR_GAIN;
    }
    if (!limits_valid(config)) {
        return KEEL_ERR_LIMITS;
    }
    status = model_filter_init(&filter, config->rate_hz, config->cutoff_hz);
    if (status != KEEL_OK) {
        return status;
    }
    /* PID-002 */
    pid->config = *config;
    pid->filter = filter;
    pid->integral_gain = config->gains.ki / config->rate_hz;
    model_pid_reset(pid);
    return KEEL_OK;
}

/* PID-003: the configuration and the low-pass stay; the next step, the first, resets the latter. */
void model_pid_reset(keel_pid_t *pid)
{
    pid->integral = 0.0f;
    pid->setpoint = 0.0f;
    pid->error = 0.0f;
    pid->derivative = 0.0f;
    pid->output = clamped(0.0f, pid->config.output_min, pid->config.output_max);
    pid->saturation = KEEL_PID_FREE;
    pid->started = false;
}

keel_status_t model_pid_set_gains(keel_pid_t *pid, const keel_pid_gains_t *gains)
{
    const float before = without_integral(&pid->config.gains, pid->setpoint, pid->error,
                                          pid->derivative);
    const float after = without_integral(gains, pid->setpoint, pid->error, pid->derivative);

    /* PID-004 */
    if (!gains_valid(gains)) {
        return KEEL_ERR_GAIN;
    }
    /* PID-005: the integral takes over what the other terms lose. */
    pid->integral = clamped(pid->integral + (before - after), pid->config.integral_min,
                            pid->config.integral_max);
    pid->config.gains = *gains;
    pid->integral_gain = gains->ki / pid->config.rate_hz;
    return KEEL_OK;
}

static keel_pid_saturation_t side_of(const keel_pid_config_t *config, float output)
{
    if (output > config->output_max) {
        return KEEL_PID_AT_MAX;
    }
    if (output < config->output_min) {
        return KEEL_PID_AT_MIN;
    }
    return KEEL_PID_FREE;
}

/* What the low-pass makes of an error. PID-009: at the first step it comes from the error itself,
 * so that the derivative is 0. */
static keel_status_t differentiated(keel_pid_t *pid, float error)
{
    const float before = pid->started ? pid->filter.output : error;
    const keel_status_t taken = pid->started ? model_filter_step(&pid->filter, error)
                                             : model_filter_reset(&pid->filter, error);

    if (taken == KEEL_OK) {
        pid->derivative = (pid->filter.output - before) * pid->config.rate_hz;
    }
    return taken;
}

keel_status_t model_pid_step(keel_pid_t *pid, float setpoint, float measurement)
{
    const float error = setpoint - measurement;
    keel_pid_t next = *pid;
    keel_pid_saturation_t side;
    float sum;
    float moved;
    float output;

    /* PID-007: a refusal, of the low-pass too, changes nothing. */
    if (!(input_valid(setpoint) && input_valid(measurement))) {
        return KEEL_ERR_INPUT;
    }
    if (differentiated(&next, error) != KEEL_OK) {
        return KEEL_ERR_INPUT;
    }
    /* PID-008: eq. 4. The integral moves within its limits. */
    sum = without_integral(&pid->config.gains, setpoint, error, next.derivative);
    moved = clamped(pid->integral + (pid->integral_gain * error), pid->config.integral_min,
                    pid->config.integral_max);
    output = sum + moved;
    side = side_of(&pid->config, output);
    /* PID-010: it stays where it was when it would move on to the side beyond a limit. */
    if (((side == KEEL_PID_AT_MAX) && (moved > pid->integral)) ||
        ((side == KEEL_PID_AT_MIN) && (moved < pid->integral))) {
        moved = pid->integral;
        output = sum + moved;
        side = side_of(&pid->config, output);
    }
    pid->filter = next.filter;
    pid->integral = moved;
    pid->setpoint = setpoint;
    pid->error = error;
    pid->derivative = next.derivative;
    pid->saturation = side;
    /* PID-006: the output stays within its limits. */
    pid->output = output;
    if (side == KEEL_PID_AT_MAX) {
        pid->output = pid->config.output_max;
    } else if (side == KEEL_PID_AT_MIN) {
        pid->output = pid->config.output_min;
    } else {
        /* As it is. */
    }
    pid->started = true;
    return KEEL_OK;
}

keel_status_t model_pid_enter(keel_pid_t *pid, float setpoint, float measurement, float output)
{
    const float error = setpoint - measurement;
    const float first = without_integral(&pid->config.gains, setpoint, error, 0.0f) +
                        (pid->integral_gain * error);

    /* PID-011 */
    if (!(input_valid(setpoint) && input_valid(measurement) && limit_valid(output))) {
        return KEEL_ERR_INPUT;
    }
    model_pid_reset(pid);
    pid->output = clamped(output, pid->config.output_min, pid->config.output_max);
    /* What the first step adds up is made up for; with ki = 0 it would be so for ever. */
    if (pid->integral_gain > 0.0f) {
        pid->integral = clamped(pid->output - first, pid->config.integral_min,
                                pid->config.integral_max);
    }
    return KEEL_OK;
}
