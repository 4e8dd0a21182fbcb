// SPDX-License-Identifier: Apache-2.0
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_pid_enter keel_pid_step_within
// covers: keel_cascade_axis_step within_reach
//
// Any valid axis, any bit pattern of what it is told; its controller does anything that its
// contract allows. The clauses that keel_cascade_axis_step_harness does not name.
#include "cascade_proof.h"

keel_status_t keel_pid_enter_stand_in(keel_pid_t *pid, float setpoint, float measurement,
                                      float output)
{
    const keel_pid_t before = *pid;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;

    (void)setpoint;
    (void)measurement;
    (void)output;
    __CPROVER_assert(keel_pid_enter_may(pid), "precondition: keel_pid_enter");
    *pid = any_pid_at_all();
    __CPROVER_assume(keel_pid_enter_does(status, pid, &before));
    return status;
}

keel_status_t keel_pid_step_within_stand_in(keel_pid_t *pid, float setpoint, float measurement,
                                            bool rises, bool falls)
{
    const keel_pid_t before = *pid;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;

    (void)measurement;
    (void)rises;
    (void)falls;
    __CPROVER_assert(keel_pid_step_within_may(pid), "precondition: keel_pid_step_within");
    *pid = any_pid_at_all();
    __CPROVER_assume(keel_pid_step_within_does(status, pid, &before, setpoint));
    return status;
}

void keel_cascade_axis_step__clauses_harness(void)
{
    const keel_cascade_input_t input = any_input();
    keel_cascade_axis_t axis = any_axis();
    bool ran;

    __CPROVER_assume(keel_cascade_axis_step_may(&axis));
    ran = axis.running;

    keel_cascade_axis_step(&axis, &input);

    __CPROVER_assert(axis_valid_here(&axis), "CAS_004_valid: a step keeps an axis valid");
    __CPROVER_assert(axis.held ||
                         (axis.running && within(axis.pid.setpoint, -axis.reach, axis.reach)),
                     "CAS_005_taken: an axis that is not held runs, at a set-point within reach");
    __CPROVER_assert(ran || !axis.running || input.valid,
                     "CAS_007_entered: an axis begins with a measurement");
}
