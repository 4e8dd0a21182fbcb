// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/pid.c specs/model/pid.c
// replaces: keel_filter_init
// covers: keel_pid_init are_gains are_limits is_limit is_gain model_pid_init
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The
// low-pass that is made is the same unknown for code and model. The solver sees that both compute
// the same only where nothing else is asked: overflow and NaN are checked in
// keel_pid_init__any_harness.
#include "../../specs/model/pid.h"
#include "pid_proof.h"
#include "told_filter.h"

void keel_pid_init_harness(void)
{
    keel_pid_config_t config = nondet_pid_config();
    const keel_pid_config_t before = config;
    keel_pid_t pid = any_pid_at_all();
    keel_pid_t model = pid;
    keel_status_t expected;
    keel_status_t status;

    tell_filter();
    expected = model_pid_init(&model, &before);

    status = keel_pid_init(&pid, &config);

    __CPROVER_assert(status == expected, "PID_001_model: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_002_model: every field is what the model says");
    __CPROVER_assert(pid_config_same(&config, &before),
                     "PID_002_frame: the configuration is not written");
}
