// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c specs/model/cascade_parts.c
// replaces: keel_pid_enter keel_pid_step_within
// covers: keel_cascade_axis_step within_reach model_cascade_axis_step lies_within next_to
//
// Any valid axis, any bit pattern of what it is told. What its controller does is unknown: the
// model's does anything that its contract allows; the code must ask the same of it in the same
// state, and is told the same.
#include "cascade_proof.h"

static keel_pid_t entered_from;
static keel_pid_t entered;
static keel_status_t entering;
static float entered_with[3];
static keel_pid_t stepped_from;
static keel_pid_t stepped;
static keel_status_t stepping;
static float stepped_with[2];
static bool moving[2];

static keel_status_t any_status(void)
{
    return nondet_bool() ? KEEL_OK : KEEL_ERR_INPUT;
}

keel_status_t model_pid_enter(keel_pid_t *pid, float setpoint, float measurement, float output)
{
    entered_from = *pid;
    entered_with[0] = setpoint;
    entered_with[1] = measurement;
    entered_with[2] = output;
    entering = any_status();
    entered = any_pid_at_all();
    __CPROVER_assume(keel_pid_enter_does(entering, &entered, pid));
    *pid = entered;
    return entering;
}

keel_status_t keel_pid_enter_stand_in(keel_pid_t *pid, float setpoint, float measurement,
                                      float output)
{
    __CPROVER_assert(keel_pid_enter_may(pid), "precondition: keel_pid_enter");
    __CPROVER_assert(pid_same(pid, &entered_from), "CAS_007_state: in the same state");
    __CPROVER_assert(float_same(setpoint, entered_with[0]) &&
                         float_same(measurement, entered_with[1]) &&
                         float_same(output, entered_with[2]),
                     "CAS_007_arguments: with the same numbers");
    *pid = entered;
    __CPROVER_assume(keel_pid_enter_does(entering, pid, &entered_from));
    return entering;
}

keel_status_t model_pid_step_within(keel_pid_t *pid, float setpoint, float measurement, bool rises,
                                    bool falls)
{
    stepped_from = *pid;
    stepped_with[0] = setpoint;
    stepped_with[1] = measurement;
    moving[0] = rises;
    moving[1] = falls;
    stepping = any_status();
    stepped = any_pid_at_all();
    __CPROVER_assume(keel_pid_step_within_does(stepping, &stepped, pid, setpoint) &&
                     integral_within(&stepped, pid, rises, falls));
    *pid = stepped;
    return stepping;
}

keel_status_t keel_pid_step_within_stand_in(keel_pid_t *pid, float setpoint, float measurement,
                                            bool rises, bool falls)
{
    __CPROVER_assert(keel_pid_step_within_may(pid), "precondition: keel_pid_step_within");
    __CPROVER_assert(pid_same(pid, &stepped_from), "CAS_004_state: in the same state");
    __CPROVER_assert(float_same(setpoint, stepped_with[0]) &&
                         float_same(measurement, stepped_with[1]),
                     "CAS_004_arguments: with the same numbers");
    __CPROVER_assert((rises == moving[0]) && (falls == moving[1]),
                     "CAS_006_moving: the integral may move the same way");
    *pid = stepped;
    __CPROVER_assume(keel_pid_step_within_does(stepping, pid, &stepped_from, setpoint));
    return stepping;
}

void keel_cascade_axis_step_harness(void)
{
    keel_cascade_axis_t axis = any_axis();
    keel_cascade_input_t input = any_input();
    const keel_cascade_input_t told = input;
    keel_cascade_axis_t before;
    keel_cascade_axis_t as_modelled;

    __CPROVER_assume(keel_cascade_axis_step_may(&axis));
    before = axis;
    as_modelled = axis;
    model_cascade_axis_step(&as_modelled, &told);

    keel_cascade_axis_step(&axis, &input);

    __CPROVER_assert(axis_same(&axis, &as_modelled),
                     "CAS_004_model: every field is what the model says");
    __CPROVER_assert(input_same(&input, &told), "CAS_004_frame: what it is told is only read");
    __CPROVER_assert(keel_cascade_axis_step_does(&axis, &before, &input),
                     "CAS_004_does: what the stages count on");
    __CPROVER_assert(pid_bounded_here(&axis.pid), "CAS_004_output: within the limits");
    __CPROVER_assert(input.valid || !axis.running, "CAS_005_stops: without a measurement");
    __CPROVER_assert(!axis.held || !before.running || pid_same(&axis.pid, &before.pid),
                     "CAS_005_held: nothing moves");
    __CPROVER_assert(!before.running || !input.below.at_max ||
                         (axis.pid.integral <= before.pid.integral),
                     "CAS_006_rises: not to where what is below is at its limit");
    __CPROVER_assert(!before.running || !input.below.at_min ||
                         (axis.pid.integral >= before.pid.integral),
                     "CAS_006_falls: in neither direction");
    __CPROVER_assert((!input.below.at_max || axis.limit.at_max) &&
                         (!input.below.at_min || axis.limit.at_min),
                     "CAS_006_told: a limit goes up the chain");
    __CPROVER_assert(axis.held || (input.setpoint > 0.0f) || !(axis.pid.setpoint > 0.0f),
                     "CAS_011_above: not further up than it is asked to go");
    __CPROVER_assert(axis.held || (input.setpoint < 0.0f) || !(axis.pid.setpoint < 0.0f),
                     "CAS_011_below: nor further down");
}
