/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pid_proof.h
 * @brief What the harnesses of the PID controller share: arbitrary valid controllers.
 */
#ifndef PID_PROOF_H
#define PID_PROOF_H

#include "../common/keel_flight_proof.h"
#include "keel/internal/flight/pid.h"

keel_pid_t nondet_pid(void);
keel_pid_config_t nondet_pid_config(void);
keel_pid_gains_t nondet_gains(void);

static bool gains_here(const keel_pid_gains_t *gains)
{
    return within(gains->kp, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           within(gains->ki, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           within(gains->kd, 0.0f, KEEL_PID_GAIN_LIMIT) &&
           within(gains->kff, 0.0f, KEEL_PID_GAIN_LIMIT);
}

static bool limits_here(const keel_pid_config_t *config)
{
    return magnitude(config->output_min, KEEL_PID_OUTPUT_LIMIT) &&
           magnitude(config->output_max, KEEL_PID_OUTPUT_LIMIT) &&
           (config->output_min < config->output_max) &&
           within(config->integral_min, -KEEL_PID_OUTPUT_LIMIT, 0.0f) &&
           within(config->integral_max, 0.0f, KEEL_PID_OUTPUT_LIMIT);
}

static bool rate_here(float rate_hz)
{
    return within(rate_hz, KEEL_FILTER_RATE_MIN_HZ, KEEL_FILTER_RATE_MAX_HZ);
}

static bool pid_input_here(float value)
{
    return magnitude(value, KEEL_PID_INPUT_LIMIT);
}

static bool pid_bounded_here(const keel_pid_t *pid)
{
    return within(pid->output, pid->config.output_min, pid->config.output_max) &&
           within(pid->integral, pid->config.integral_min, pid->config.integral_max);
}

static bool pid_remembers_here(const keel_pid_t *pid)
{
    return pid_input_here(pid->setpoint) && filter_input_here(pid->error) &&
           magnitude(pid->derivative, KEEL_PID_DERIVATIVE_LIMIT);
}

static bool pid_valid_here(const keel_pid_t *pid)
{
    return gains_here(&pid->config.gains) && limits_here(&pid->config) &&
           rate_here(pid->config.rate_hz) &&
           magnitude(pid->integral_gain, KEEL_PID_INTEGRAL_GAIN_LIMIT) &&
           filter_coefficients_here(&pid->filter) && filter_bounded_here(&pid->filter) &&
           pid_bounded_here(pid) && pid_remembers_here(pid) && (pid->saturation <= KEEL_PID_AT_MAX);
}

static bool pid_gains_same(const keel_pid_gains_t *x, const keel_pid_gains_t *y)
{
    return float_same(x->kp, y->kp) && float_same(x->ki, y->ki) && float_same(x->kd, y->kd) &&
           float_same(x->kff, y->kff);
}

static bool pid_config_same(const keel_pid_config_t *x, const keel_pid_config_t *y)
{
    return pid_gains_same(&x->gains, &y->gains) && float_same(x->rate_hz, y->rate_hz) &&
           float_same(x->cutoff_hz, y->cutoff_hz) && float_same(x->output_min, y->output_min) &&
           float_same(x->output_max, y->output_max) &&
           float_same(x->integral_min, y->integral_min) &&
           float_same(x->integral_max, y->integral_max);
}

static bool pid_same(const keel_pid_t *x, const keel_pid_t *y)
{
    return pid_config_same(&x->config, &y->config) && filter_same(&x->filter, &y->filter) &&
           float_same(x->integral_gain, y->integral_gain) && float_same(x->integral, y->integral) &&
           float_same(x->setpoint, y->setpoint) && float_same(x->error, y->error) &&
           float_same(x->derivative, y->derivative) && float_same(x->output, y->output) &&
           (x->saturation == y->saturation) && (x->started == y->started);
}

static keel_pid_t any_pid_at_all(void)
{
    keel_pid_t pid = nondet_pid();

    pid.started = nondet_bool();
    return pid;
}

/* Any valid controller (pid_valid). */
static keel_pid_t any_pid(void)
{
    keel_pid_t pid = any_pid_at_all();

    any_filter(&pid.filter);
    __CPROVER_assume(pid_valid_here(&pid));
    return pid;
}

#endif
