// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_enter direct_terms is_input is_limit
// covers: model_pid_enter without_integral
//
// Entered and stepped, on small whole numbers, whose sums and products are exact: the first output
// is the one to begin at, where the integral's limits let it. 2 Hz, ki T instead of ki. A
// number beyond its limits is refused.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

static int any_small(void)
{
    return ((int)(nondet_u8() & 1u) * 3) - 2;
}

static int any_gain(void)
{
    return (int)(nondet_u8() & 1u) * 2;
}

static int limited(int value, int least, int greatest)
{
    return (value < least) ? least : ((value > greatest) ? greatest : value);
}

void keel_pid_enter__exact_harness(void)
{
    const int kp = any_gain();
    const int ki = any_gain();
    const int kd = any_gain();
    const int kff = any_gain();
    const int r = any_small();
    const int y = any_small();
    const int output = any_small() * 8;
    const unsigned bad = nondet_u8() & 3u;
    const float setpoint = (bad == 1u) ? (2.0f * KEEL_PID_INPUT_LIMIT) : (float)r;
    const float measured = (bad == 2u) ? (2.0f * KEEL_PID_INPUT_LIMIT) : (float)y;
    const float wanted = (bad == 3u) ? (2.0f * KEEL_PID_OUTPUT_LIMIT) : (float)output;
    const int begin = limited(output, -14, 6);
    const int first = (kp * (r - y)) + (kff * r) + (ki * (r - y));
    const int integral = (ki > 0) ? limited(begin - first, -16, 15) : 0;
    keel_pid_t pid = {.config = {.gains = {(float)kp, 0.0f, (float)kd, (float)kff},
                                 .rate_hz = 2.0f,
                                 .output_min = -14.0f,
                                 .output_max = 6.0f,
                                 .integral_min = -16.0f,
                                 .integral_max = 15.0f},
                      .filter = {.a = 1.0f, .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT},
                      .integral_gain = (float)ki,
                      .integral = 3.0f,
                      .setpoint = 2.0f,
                      .error = 1.0f,
                      .derivative = 5.0f,
                      .output = 1.0f,
                      .saturation = KEEL_PID_AT_MAX,
                      .started = nondet_bool()};
    keel_pid_t model = pid;
    const keel_status_t status = keel_pid_enter(&pid, setpoint, measured, wanted);

    __CPROVER_assert(status == ((bad > 0u) ? KEEL_ERR_INPUT : KEEL_OK),
                     "PID_011_taken: what is in range is taken");
    __CPROVER_assert(model_pid_enter(&model, setpoint, measured, wanted) == status,
                     "PID_011_taken: the model takes it, too");
    __CPROVER_assert(pid_same(&pid, &model), "PID_011_model: every field is what the model says");
    if (bad > 0u) {
        return;
    }
    __CPROVER_assert((pid.integral == (float)integral) && (pid.output == (float)begin),
                     "PID_011_integral: what the other terms lack");
    __CPROVER_assert((pid.setpoint == 0.0f) && (pid.error == 0.0f) && (pid.derivative == 0.0f) &&
                         (pid.saturation == KEEL_PID_FREE) && !pid.started,
                     "PID_011_fresh: the rest as after a reset");
    __CPROVER_assert(keel_pid_step(&pid, (float)r, (float)y) == KEEL_OK,
                     "PID_011_step: the first step is taken");
    __CPROVER_assert((ki == 0) || (integral != (begin - first)) ||
                         (pid.integral != (float)(integral + (ki * (r - y)))) ||
                         (pid.output == (float)begin),
                     "PID_011_bumpless: the first output is the one to begin at");
}
