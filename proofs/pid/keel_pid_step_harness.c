// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_step differentiate winds_up put_out limit_reached direct_terms is_input
//
// Any valid controller, any bit pattern for both inputs: one step of the induction that keeps the
// output and the integral within their limits.
#include "../common/keel_pid_proof.h"
#include "../common/unchanged.h"

void keel_pid_step_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    keel_status_t status;

    status = keel_pid_step(&pid, setpoint, measurement);

    __CPROVER_assert(pid_bounded_here(&pid), "PID_006_bounded: output and integral in limits");
    __CPROVER_assert(pid_valid_here(&pid), "PID_006_valid: and the controller stays valid");
    __CPROVER_assert(config_same(&pid.config, &before.config) &&
                         same(pid.integral_gain, before.integral_gain),
                     "PID_006_frame: what was configured stays");
    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_INPUT),
                     "PID_007_status: taken or refused");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&pid, &before, sizeof(pid)),
                     "STA_001_kept: a refusal changes nothing");
    if (status != KEEL_OK) {
        __CPROVER_assert(pid_same(&pid, &before), "PID_007_held: a refusal changes nothing");
        return;
    }
    __CPROVER_assert(pid_input_here(setpoint) && pid_input_here(measurement),
                     "PID_007_input: what is taken is in range");
    __CPROVER_assert(pid.started && (pid.setpoint == setpoint), "PID_008_started: the step counts");
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
