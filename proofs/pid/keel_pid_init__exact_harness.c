// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c specs/model/pid.c
// replaces: keel_filter_init
// covers: keel_pid_init model_pid_init
//
// ki T, in numbers whose quotient is exact: at 4 Hz. Two gains are bad. The low-pass is any, or
// refused, the same for code and model.
#include "../../specs/model/pid.h"
#include "pid_proof.h"
#include "told_filter.h"

void keel_pid_init__exact_harness(void)
{
    const int ki = (int)(nondet_u8() & 15u) - 2;
    const bool limits = nondet_bool();
    const keel_pid_config_t config = {.gains = {1.0f, (float)ki, 0.0f, 0.0f},
                                      .rate_hz = 4.0f,
                                      .cutoff_hz = 1.0f,
                                      .output_min = -1.0f,
                                      .output_max = limits ? 1.0f : -1.0f};
    keel_pid_t pid = any_pid_at_all();
    keel_pid_t model = pid;
    keel_status_t expected;
    keel_status_t status;

    tell_filter();
    expected = model_pid_init(&model, &config);

    status = keel_pid_init(&pid, &config);

    __CPROVER_assert(status == expected, "PID_001_model: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_002_model: every field is what the model says");

    __CPROVER_assert((status == KEEL_OK) == ((ki >= 0) && limits && (making == KEEL_OK)),
                     "PID_002_ok: taken when all is good");
    __CPROVER_assert((status != KEEL_OK) || ((pid.integral_gain * 4.0f) == (float)ki),
                     "PID_002_integral_gain: ki over the rate");
}
