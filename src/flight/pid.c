/* SPDX-License-Identifier: Apache-2.0 */
#include "keel/internal/flight/pid.h"

#include "keel/middleware/range.h"

/*@ assigns \nothing;
  @ ensures \result <==> pid_gain(gain);
  @*/
static bool is_gain(float gain)
{
    return keel_range_contains(gain, 0.0f, KEEL_PID_GAIN_LIMIT);
}

/*@ requires \valid_read(gains);
  @ assigns \nothing;
  @ ensures \result <==> pid_gains(*gains);
  @*/
static bool are_gains(const keel_pid_gains_t *gains)
{
    return is_gain(gains->kp) && is_gain(gains->ki) && is_gain(gains->kd) && is_gain(gains->kff);
}

/*@ assigns \nothing;
  @ ensures \result <==> filter_magnitude(value, KEEL_PID_OUTPUT_LIMIT);
  @*/
static bool is_limit(float value)
{
    return keel_range_contains(value, -KEEL_PID_OUTPUT_LIMIT, KEEL_PID_OUTPUT_LIMIT);
}

/*@ requires \valid_read(config);
  @ assigns \nothing;
  @ ensures \result <==> pid_limits(*config);
  @*/
static bool are_limits(const keel_pid_config_t *config)
{
    return is_limit(config->output_min) && is_limit(config->output_max) &&
           is_limit(config->integral_min) && is_limit(config->integral_max) &&
           (config->output_min < config->output_max) && (config->integral_min <= 0.0f) &&
           (config->integral_max >= 0.0f);
}

/*@ assigns \nothing;
  @ ensures \result <==> pid_input(value);
  @*/
static bool is_input(float value)
{
    return keel_range_contains(value, -KEEL_PID_INPUT_LIMIT, KEEL_PID_INPUT_LIMIT);
}

/* All terms of eq. 4 but the integral. */
/*@ requires \valid_read(gains);
  @ assigns \nothing;
  @*/
static float direct_terms(const keel_pid_gains_t *gains, float setpoint, float error,
                          float derivative)
{
    return ((gains->kp * error) + (gains->kff * setpoint)) + (gains->kd * derivative);
}

keel_status_t keel_pid_init(keel_pid_t *pid, const keel_pid_config_t *config)
{
    keel_filter_t filter;
    keel_status_t status;

    if (!are_gains(&config->gains)) {
        return KEEL_ERR_GAIN;
    }
    if (!are_limits(config)) {
        return KEEL_ERR_LIMITS;
    }
    status = keel_filter_init(&filter, config->rate_hz, config->cutoff_hz);
    if (status != KEEL_OK) {
        return status;
    }
    pid->config = *config;
    //@ assert copied: pid_limits(pid->config);
    keel_pid_reset(pid);
    pid->filter = filter;
    pid->integral_gain = config->gains.ki / config->rate_hz;
    return KEEL_OK;
}

void keel_pid_reset(keel_pid_t *pid)
{
    pid->integral = 0.0f;
    pid->setpoint = 0.0f;
    pid->error = 0.0f;
    pid->derivative = 0.0f;
    pid->output = keel_range_clamp(0.0f, pid->config.output_min, pid->config.output_max);
    pid->saturation = KEEL_PID_FREE;
    pid->started = false;
}

keel_status_t keel_pid_set_gains(keel_pid_t *pid, const keel_pid_gains_t *gains)
{
    float before;
    float after;

    if (!are_gains(gains)) {
        return KEEL_ERR_GAIN;
    }
    before = direct_terms(&pid->config.gains, pid->setpoint, pid->error, pid->derivative);
    after = direct_terms(gains, pid->setpoint, pid->error, pid->derivative);
    pid->integral = keel_range_clamp(pid->integral + (before - after), pid->config.integral_min,
                                     pid->config.integral_max);
    pid->config.gains = *gains;
    pid->integral_gain = gains->ki / pid->config.rate_hz;
    return KEEL_OK;
}

/* Moves the low-pass on, and the derivative with it. The first error is where the low-pass starts
 * from, as if it had been there for ever. */
/*@ requires \valid(pid) && filter_valid(pid->filter);
  @ assigns pid->filter.s1, pid->filter.s2, pid->filter.output, pid->derivative;
  @*/
static keel_status_t differentiate_error(keel_pid_t *pid, float error)
{
    const float before = pid->started ? pid->filter.output : error;
    const keel_status_t status = pid->started ? keel_filter_step(&pid->filter, error)
                                              : keel_filter_reset(&pid->filter, error);

    if (status == KEEL_OK) {
        pid->derivative = (pid->filter.output - before) * pid->config.rate_hz;
    }
    return status;
}

/*@ requires \valid_read(config) && pid_limits(*config);
  @ assigns \nothing;
  @ ensures \is_finite(output) ==> (\result == KEEL_PID_AT_MAX <==> output > config->output_max);
  @ ensures \is_finite(output) ==> (\result == KEEL_PID_AT_MIN <==> output < config->output_min);
  @ ensures \is_finite(output) ==> (\result == KEEL_PID_FREE <==>
  @     pid_within(output, config->output_min, config->output_max));
  @*/
static keel_pid_saturation_t limit_reached(const keel_pid_config_t *config, float output)
{
    keel_pid_saturation_t at = KEEL_PID_FREE;

    if (output > config->output_max) {
        at = KEEL_PID_AT_MAX;
    } else if (output < config->output_min) {
        at = KEEL_PID_AT_MIN;
    } else {
        /* Within the limits. */
    }
    return at;
}

/*@ requires \is_finite(from) && \is_finite(to);
  @ assigns \nothing;
  @ ensures \result <==> (at == KEEL_PID_AT_MAX && to > from) ||
  @     (at == KEEL_PID_AT_MIN && to < from);
  @*/
static bool winds_up(keel_pid_saturation_t at, float from, float to)
{
    return ((at == KEEL_PID_AT_MAX) && (to > from)) || ((at == KEEL_PID_AT_MIN) && (to < from));
}

/* The integral moves, but not further in the direction in which the output is beyond a limit. */
/*@ requires \valid(pid) && pid_limits(pid->config) && \is_finite(pid->integral);
  @ assigns pid->integral, pid->saturation, pid->output;
  @*/
static void put_out(keel_pid_t *pid, float direct, float error)
{
    const float moved = keel_range_clamp(pid->integral + (pid->integral_gain * error),
                                         pid->config.integral_min, pid->config.integral_max);
    float output = direct + moved;
    keel_pid_saturation_t at = limit_reached(&pid->config, output);

    if (winds_up(at, pid->integral, moved)) {
        output = direct + pid->integral;
        at = limit_reached(&pid->config, output);
    } else {
        pid->integral = moved;
    }
    pid->saturation = at;
    pid->output = output;
    if (at == KEEL_PID_AT_MAX) {
        pid->output = pid->config.output_max;
    } else if (at == KEEL_PID_AT_MIN) {
        pid->output = pid->config.output_min;
    } else {
        /* As it is. */
    }
}

keel_status_t keel_pid_step(keel_pid_t *pid, float setpoint, float measurement)
{
    float error;
    float direct;

    if (!(is_input(setpoint) && is_input(measurement))) {
        return KEEL_ERR_INPUT;
    }
    error = setpoint - measurement;
    if (differentiate_error(pid, error) != KEEL_OK) {
        return KEEL_ERR_INPUT;
    }
    direct = direct_terms(&pid->config.gains, setpoint, error, pid->derivative);
    put_out(pid, direct, error);
    pid->setpoint = setpoint;
    pid->error = error;
    pid->started = true;
    return KEEL_OK;
}

keel_status_t keel_pid_enter(keel_pid_t *pid, float setpoint, float measurement, float output)
{
    if (!(is_input(setpoint) && is_input(measurement) && is_limit(output))) {
        return KEEL_ERR_INPUT;
    }
    keel_pid_reset(pid);
    pid->output = keel_range_clamp(output, pid->config.output_min, pid->config.output_max);
    if (pid->integral_gain > 0.0f) {
        /* The first step also adds these: its derivative is 0, and its integral moves. */
        const float first = setpoint - measurement;
        const float direct = direct_terms(&pid->config.gains, setpoint, first, 0.0f) +
                             (pid->integral_gain * first);
        pid->integral = keel_range_clamp(pid->output - direct, pid->config.integral_min,
                                         pid->config.integral_max);
    }
    return KEEL_OK;
}

keel_status_t keel_pid_step_within(keel_pid_t *pid, float setpoint, float measurement, bool rises,
                                   bool falls)
{
    const float before = pid->integral;
    const keel_status_t status = keel_pid_step(pid, setpoint, measurement);

    if (((pid->integral > before) && !rises) || ((pid->integral < before) && !falls)) {
        pid->integral = before;
    }
    return status;
}
