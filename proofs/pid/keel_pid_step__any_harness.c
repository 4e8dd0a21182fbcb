// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c
// replaces: keel_filter_step keel_filter_reset
// covers: keel_pid_step differentiate_error winds_up put_out limit_reached direct_terms is_input
//
// Any valid controller, any bit pattern for both inputs: one step of the induction that keeps the
// output and the integral within their limits. What the step computes is in keel_pid_step_harness.
#include "../common/filter_contracts.h"
#include "../common/pid_contracts.h"
#include "../common/unchanged.h"

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

void keel_pid_step__any_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_step_may(&pid));

    status = keel_pid_step(&pid, setpoint, measurement);

    __CPROVER_assert(keel_pid_step_does(status, &pid, &before, setpoint, measurement),
                     "PID_006_any: what stands in for it elsewhere");
    __CPROVER_assert(pid_valid_here(&pid), "PID_006_valid: the controller stays valid");
    if (status != KEEL_OK) {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
        return;
    }
    __CPROVER_assert(before.started || (pid.derivative == 0.0f),
                     "PID_009_no_kick: the first step has no derivative");
    if (pid.saturation == KEEL_PID_AT_MAX) {
        __CPROVER_assert(pid.output == pid.config.output_max, "PID_010_at_max: at the limit");
        __CPROVER_assert(pid.integral <= before.integral, "PID_010_at_max: no wind-up");
    }
    if (pid.saturation == KEEL_PID_AT_MIN) {
        __CPROVER_assert(pid.output == pid.config.output_min, "PID_010_at_min: at the limit");
        __CPROVER_assert(pid.integral >= before.integral, "PID_010_at_min: no wind-up");
    }
}
