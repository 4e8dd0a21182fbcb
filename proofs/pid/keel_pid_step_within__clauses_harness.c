// SPDX-License-Identifier: Apache-2.0
// checks: assertions
// sources: src/flight/pid.c
// replaces: keel_pid_step
// covers: keel_pid_step_within
//
// As keel_pid_step_within__any_harness: any valid controller, any bit pattern for both inputs, and
// the contract, clause by clause.
#include "../common/pid_contracts.h"

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

void keel_pid_step_within__clauses_harness(void)
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

    __CPROVER_assert(pid_valid_here(&pid), "PID_012_bounded: the controller stays valid");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_INPUT),
                     "PID_012_status: taken or refused");
    __CPROVER_assert((status != KEEL_OK) ||
                         (pid_input_here(setpoint) && pid_input_here(measurement)),
                     "PID_012_input: what is taken is in range");
    __CPROVER_assert((status != KEEL_ERR_INPUT) || pid_same(&pid, &before),
                     "PID_012_held: what is refused changes nothing");
    __CPROVER_assert((status != KEEL_OK) || (pid.started && (pid.setpoint == setpoint)),
                     "PID_012_started: the step counts, with its set-point");
    __CPROVER_assert(rises || (pid.integral <= before.integral),
                     "PID_012_rises: where it may not, the integral does not rise");
    __CPROVER_assert(falls || (pid.integral >= before.integral),
                     "PID_012_falls: where it may not, it does not fall");
}
