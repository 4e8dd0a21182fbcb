/* SPDX-License-Identifier: Apache-2.0 */
/**
 * @file pid.h
 * @brief What the functions of keel/flight/pid.h do.
 */
#ifndef MODEL_PID_H
#define MODEL_PID_H

#include "keel/flight/pid.h"

keel_status_t model_pid_init(keel_pid_t *pid, const keel_pid_config_t *config);

void model_pid_reset(keel_pid_t *pid);

keel_status_t model_pid_set_gains(keel_pid_t *pid, const keel_pid_gains_t *gains);

keel_status_t model_pid_step(keel_pid_t *pid, float setpoint, float measurement);

keel_status_t model_pid_enter(keel_pid_t *pid, float setpoint, float measurement, float output);

keel_status_t model_pid_step_within(keel_pid_t *pid, float setpoint, float measurement, bool rises,
                                    bool falls);

#endif
