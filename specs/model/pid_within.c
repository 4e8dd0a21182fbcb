/* SPDX-License-Identifier: Apache-2.0 */
#include "pid.h"

keel_status_t model_pid_step_within(keel_pid_t *pid, float setpoint, float measurement, bool rises,
                                    bool falls)
{
    const float before = pid->integral;
    const keel_status_t status = model_pid_step(pid, setpoint, measurement);

    /* PID-012: it moves only where it may. */
    if (!rises && (pid->integral > before)) {
        pid->integral = before;
    }
    if (!falls && (pid->integral < before)) {
        pid->integral = before;
    }
    return status;
}
