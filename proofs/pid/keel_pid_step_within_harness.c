// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_step_within model_pid_step_within
//
// Any controller at all, any bit pattern for both inputs: the same as the model's, bit for bit. The
// solver sees that both compute the same only where nothing else is asked: overflow and NaN are
// checked in keel_pid_step_within__any_harness.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

void keel_pid_step_within_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    const bool rises = nondet_bool();
    const bool falls = nondet_bool();
    keel_pid_t pid = any_pid_at_all();
    keel_pid_t model = pid;
    const keel_status_t status = keel_pid_step_within(&pid, setpoint, measurement, rises, falls);

    __CPROVER_assert(status == model_pid_step_within(&model, setpoint, measurement, rises, falls),
                     "PID_012_taken: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_012_model: every field is what the model says");
}
