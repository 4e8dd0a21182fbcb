// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_reset model_pid_reset
#include "../../specs/model/pid.h"
#include "pid_proof.h"

void keel_pid_reset_harness(void)
{
    keel_pid_t pid = any_pid();
    keel_pid_t model = pid;

    keel_pid_reset(&pid);
    model_pid_reset(&model);

    __CPROVER_assert(pid_same(&pid, &model), "PID_003_model: every field is what the model says");
    __CPROVER_assert(pid_valid_here(&pid), "PID_003_valid: the controller stays valid");
}
