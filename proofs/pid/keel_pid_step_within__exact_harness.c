// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// sources: specs/model/pid_within.c
// covers: keel_pid_step_within model_pid_step_within
//
// On small whole numbers, zeros of either sign: the integral moves by ki T e where it may, and
// stays elsewhere; the output is that of the step. The model does the same. Wrong bodies are
// refuted here: where floats differ, z3 finds no example.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

static int any_small(void)
{
    return (int)(nondet_u8() & 7u) - 4;
}

void keel_pid_step_within__exact_harness(void)
{
    const int r = any_small();
    const int y = any_small();
    const int old = any_small();
    const bool rises = nondet_bool();
    const bool falls = nondet_bool();
    const bool far = nondet_bool();
    const bool negative = nondet_bool();
    const bool stays = ((r > y) && !rises) || ((r < y) && !falls);
    keel_pid_t pid = {.config = {.gains = {2.0f, 0.0f, 0.0f, 0.0f},
                                 .rate_hz = 2.0f,
                                 .output_min = -64.0f,
                                 .output_max = 64.0f,
                                 .integral_min = -64.0f,
                                 .integral_max = 64.0f},
                      .filter = {.a = 1.0f, .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT},
                      .integral_gain = 1.0f,
                      .integral = ((old == 0) && negative) ? -0.0f : (float)old};
    keel_pid_t model = pid;
    const float setpoint = far ? 1.0e6f : (float)r;
    const keel_status_t status = keel_pid_step_within(&pid, setpoint, (float)y, rises, falls);

    __CPROVER_assert(status == model_pid_step_within(&model, setpoint, (float)y, rises, falls),
                     "PID_012_taken: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_012_model: every field is what the model says");
    __CPROVER_assert((status == KEEL_OK) == !far, "PID_012_ok: taken when in range");
    __CPROVER_assert(far || (pid.integral == (float)(stays ? old : (old + (r - y)))),
                     "PID_012_integral: moves where it may");
    __CPROVER_assert(far || (pid.output == (float)((2 * (r - y)) + old + (r - y))),
                     "PID_012_output: that of the step");
}
