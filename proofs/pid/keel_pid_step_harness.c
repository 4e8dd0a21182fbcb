// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_step differentiate_error winds_up put_out limit_reached direct_terms is_input
// covers: model_pid_step without_integral side_of differentiated
//
// Any controller at all, any bit pattern for both inputs: the same as the model's, bit for bit. The
// solver sees that both compute the same only where nothing else is asked: overflow and NaN are
// checked in keel_pid_step__any_harness.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

void keel_pid_step_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    keel_pid_t pid = any_pid_at_all();
    keel_pid_t model = pid;
    const keel_status_t status = keel_pid_step(&pid, setpoint, measurement);

    __CPROVER_assert(status == model_pid_step(&model, setpoint, measurement),
                     "PID_007_model: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_008_model: every field is what the model says");
}
