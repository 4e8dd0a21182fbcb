// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/pid.c
// replaces: keel_filter_step keel_filter_reset
// covers: keel_pid_step differentiate_error winds_up put_out limit_reached direct_terms is_input
//
// As keel_pid_step__any_harness: any valid controller, any bit pattern for both inputs, and the
// contract of a step, clause by clause. Those of PID-009 and PID-010 are there.
#include "../common/filter_contracts.h"
#include "../common/pid_contracts.h"

keel_status_t keel_filter_step_stand_in(keel_filter_t *filter, float input)
{
    const keel_filter_t before = *filter;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;

    __CPROVER_assert(keel_filter_step_may(filter), "precondition: keel_filter_step");
    *filter = nondet_filter();
    __CPROVER_assume(keel_filter_step_does(status, filter, &before, input));
    return status;
}

keel_status_t keel_filter_reset_stand_in(keel_filter_t *filter, float value)
{
    const keel_filter_t before = *filter;
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;

    __CPROVER_assert(keel_filter_reset_may(filter), "precondition: keel_filter_reset");
    *filter = nondet_filter();
    __CPROVER_assume(keel_filter_reset_does(status, filter, &before, value));
    return status;
}

void keel_pid_step__clauses_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_step_may(&pid));

    status = keel_pid_step(&pid, setpoint, measurement);

    __CPROVER_assert(pid_valid_here(&pid), "PID_006_bounded: the controller stays valid");
    __CPROVER_assert((status != KEEL_OK) ||
                         (pid_input_here(setpoint) && pid_input_here(measurement)),
                     "PID_007_input: what is taken is in range");
    __CPROVER_assert((status != KEEL_ERR_INPUT) || pid_same(&pid, &before),
                     "PID_007_held: what is refused changes nothing");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_INPUT),
                     "PID_007_status: taken or refused");
    __CPROVER_assert((status != KEEL_OK) || (pid.started && (pid.setpoint == setpoint)),
                     "PID_008_started: the step counts, with its set-point");
}
