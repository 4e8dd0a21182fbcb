// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_set_gains direct_terms model_pid_set_gains without_integral
//
// What the integral takes over, on small whole numbers, whose sums and products are exact; 2 Hz.
// Wrong bodies are refuted here: where floats differ, z3 finds no example.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

static int any_small(void)
{
    return ((int)(nondet_u8() & 1u) * 3) - 1;
}

static int any_gain(void)
{
    return ((int)(nondet_u8() & 1u) * 2) + 1;
}

static int limited(int value, int least, int greatest)
{
    return (value < least) ? least : ((value > greatest) ? greatest : value);
}

void keel_pid_set_gains__exact_harness(void)
{
    const int kp = any_gain();
    const int kd = any_gain();
    const int kff = any_gain();
    const int new_kp = any_small(); /* -1 is refused */
    const int new_ki = any_gain();
    const int new_kd = any_gain();
    const int new_kff = any_gain();
    const int setpoint = any_small();
    const int error = any_small();
    const int derivative = any_small();
    const int old = any_small();
    const int before = (kp * error) + (kff * setpoint) + (kd * derivative);
    const int after = (new_kp * error) + (new_kff * setpoint) + (new_kd * derivative);
    const keel_pid_gains_t gains = {(float)new_kp, (float)new_ki, (float)new_kd, (float)new_kff};
    keel_pid_t pid = {.config = {.gains = {(float)kp, 0.0f, (float)kd, (float)kff},
                                 .rate_hz = 2.0f,
                                 .output_min = -16.0f,
                                 .output_max = 16.0f,
                                 .integral_min = -6.0f,
                                 .integral_max = 5.0f},
                      .filter = {.a = 1.0f, .energy_limit = KEEL_FILTER_LOW_ENERGY_LIMIT},
                      .integral = (float)old,
                      .setpoint = (float)setpoint,
                      .error = (float)error,
                      .derivative = (float)derivative};
    keel_pid_t model = pid;
    const keel_status_t status = keel_pid_set_gains(&pid, &gains);

    __CPROVER_assert(status == model_pid_set_gains(&model, &gains),
                     "PID_004_model: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_005_model: every field is what the model says");

    __CPROVER_assert((status == KEEL_OK) == (new_kp >= 0), "PID_004_ok: taken when good");
    if (status == KEEL_OK) {
        __CPROVER_assert(pid.integral == (float)limited(old + (before - after), -6, 5),
                         "PID_005_takes_over: what the other terms lose");
        __CPROVER_assert((pid.integral_gain * 2.0f) == (float)new_ki,
                         "PID_005_integral_gain: ki over the rate");
    }
}
