/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pid_contracts.h
 * @brief The contracts of the PID controller's functions, for CBMC: what their own harnesses prove,
 *        and what stands in for them where code that calls them is proved.
 */
#ifndef PID_CONTRACTS_H
#define PID_CONTRACTS_H

#include "../pid/pid_proof.h"

/* What no function but init writes. */
static bool pid_made_as_before(const keel_pid_t *pid, const keel_pid_t *before)
{
    return pid_config_same(&pid->config, &before->config) &&
           float_same(pid->integral_gain, before->integral_gain) &&
           float_same(pid->filter.a, before->filter.a) &&
           float_same(pid->filter.b, before->filter.b) &&
           float_same(pid->filter.c, before->filter.c) &&
           float_same(pid->filter.energy_limit, before->filter.energy_limit);
}

static bool keel_pid_init_may(void)
{
    return true;
}

static bool keel_pid_init_does(keel_status_t status, const keel_pid_t *pid,
                               const keel_pid_config_t *config)
{
    return (status != KEEL_OK) ||
           (pid_valid_here(pid) && !pid->started && (pid->saturation == KEEL_PID_FREE) &&
            pid_config_same(&pid->config, config));
}

static bool keel_pid_enter_may(const keel_pid_t *pid)
{
    return pid_valid_here(pid);
}

static bool keel_pid_enter_does(keel_status_t status, const keel_pid_t *pid,
                                const keel_pid_t *before)
{
    const bool entered = (status == KEEL_OK) && !pid->started &&
                         (pid->saturation == KEEL_PID_FREE) &&
                         float_same(pid->filter.s1, before->filter.s1) &&
                         float_same(pid->filter.s2, before->filter.s2) &&
                         float_same(pid->filter.output, before->filter.output);
    const bool refused = (status == KEEL_ERR_INPUT) && pid_same(pid, before);

    return pid_valid_here(pid) && pid_made_as_before(pid, before) && (entered || refused);
}

static bool keel_pid_step_may(const keel_pid_t *pid)
{
    return pid_valid_here(pid);
}

static bool keel_pid_step_does(keel_status_t status, const keel_pid_t *pid,
                               const keel_pid_t *before, float setpoint, float measurement)
{
    const bool stepped = (status == KEEL_OK) && pid->started &&
                         float_same(pid->setpoint, setpoint) && pid_input_here(setpoint) &&
                         pid_input_here(measurement);
    const bool refused = (status == KEEL_ERR_INPUT) && pid_same(pid, before);

    return pid_valid_here(pid) && pid_made_as_before(pid, before) && (stepped || refused);
}

static bool keel_pid_step_within_may(const keel_pid_t *pid)
{
    return pid_valid_here(pid);
}

static bool keel_pid_step_within_does(keel_status_t status, const keel_pid_t *pid,
                                      const keel_pid_t *before, float setpoint)
{
    const bool stepped = (status == KEEL_OK) && pid->started && float_same(pid->setpoint, setpoint);
    const bool refused = (status == KEEL_ERR_INPUT) && pid_same(pid, before);

    return pid_valid_here(pid) && pid_made_as_before(pid, before) && (stepped || refused);
}

/* To be asked beside the former. */
static bool integral_within(const keel_pid_t *pid, const keel_pid_t *before, bool rises, bool falls)
{
    return (rises || (pid->integral <= before->integral)) &&
           (falls || (pid->integral >= before->integral));
}

#endif
