// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c
// replaces: keel_pid_step
// covers: keel_pid_step_within
//
// Any valid controller, any bit pattern for both inputs: it stays valid, its integral moves only
// where it may, and a refusal changes nothing. What the step computes is in
// keel_pid_step_within_harness.
#include "../common/pid_contracts.h"
#include "../common/unchanged.h"

keel_status_t keel_pid_step_stand_in(keel_pid_t *pid, float setpoint, float measurement)
{
    const keel_pid_t before = *pid;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;

    __CPROVER_assert(keel_pid_step_may(pid), "precondition: keel_pid_step");
    if (status == KEEL_OK) {
        *pid = any_pid_at_all();
    }
    __CPROVER_assume(keel_pid_step_does(status, pid, &before, setpoint, measurement));
    return status;
}

void keel_pid_step_within__any_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    const bool rises = nondet_bool();
    const bool falls = nondet_bool();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_step_within_may(&pid));

    status = keel_pid_step_within(&pid, setpoint, measurement, rises, falls);

    __CPROVER_assert(keel_pid_step_within_does(status, &pid, &before, setpoint),
                     "PID_012_any: stepped, or as it was");
    __CPROVER_assert(integral_within(&pid, &before, rises, falls),
                     "PID_012_holds: the integral does not move where it may not");
    if (status == KEEL_OK) {
        __CPROVER_assert(pid_input_here(setpoint) && pid_input_here(measurement),
                         "PID_012_input: of good inputs");
    } else {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
