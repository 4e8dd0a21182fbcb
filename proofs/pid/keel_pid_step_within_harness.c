// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/flight/pid.c specs/model/pid_within.c
// replaces: keel_pid_step
// covers: keel_pid_step_within model_pid_step_within
//
// Any valid controller, any bit pattern for both inputs: the same as the model's, bit for bit. What
// a step makes of a controller is the same unknown for code and model; that the step itself is the
// model's, keel_pid_step_harness shows.
#include "../../specs/model/pid.h"
#include "../common/pid_contracts.h"

static keel_pid_t before;

/* What the model was asked, and the answer. */
static float asked_setpoint;
static float asked_measurement;
static keel_pid_t stepped;
static keel_status_t taken;

keel_status_t model_pid_step(keel_pid_t *pid, float setpoint, float measurement)
{
    asked_setpoint = setpoint;
    asked_measurement = measurement;
    *pid = stepped;
    __CPROVER_assume(keel_pid_step_does(taken, pid, &before, setpoint, measurement));
    return taken;
}

keel_status_t keel_pid_step_stand_in(keel_pid_t *pid, float setpoint, float measurement)
{
    __CPROVER_assert(keel_pid_step_may(pid), "precondition: keel_pid_step");
    __CPROVER_assert(pid_same(pid, &before) && float_same(setpoint, asked_setpoint) &&
                         float_same(measurement, asked_measurement),
                     "PID_012_asked: the controller as it is, and its inputs");
    *pid = stepped;
    __CPROVER_assume(keel_pid_step_does(taken, pid, &before, setpoint, measurement));
    return taken;
}

void keel_pid_step_within_harness(void)
{
    const float setpoint = nondet_float();
    const float measurement = nondet_float();
    const bool rises = nondet_bool();
    const bool falls = nondet_bool();
    keel_pid_t pid = any_pid();
    keel_pid_t model = pid;
    keel_status_t expected;
    keel_status_t status;

    before = pid;
    stepped = any_pid_at_all();
    taken = nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;
    expected = model_pid_step_within(&model, setpoint, measurement, rises, falls);

    status = keel_pid_step_within(&pid, setpoint, measurement, rises, falls);

    __CPROVER_assert(status == expected, "PID_012_taken: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_012_model: every field is what the model says");
}
