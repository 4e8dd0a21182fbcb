// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_set_gains direct_terms are_gains is_gain
//
// Any valid controller, any bit pattern for the gains: it stays valid, and no operation overflows
// or gives a NaN. What changes is in keel_pid_set_gains_harness.
#include "../common/unchanged.h"
#include "pid_proof.h"

void keel_pid_set_gains__valid_harness(void)
{
    const keel_pid_gains_t gains = nondet_gains();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    const keel_status_t status = keel_pid_set_gains(&pid, &gains);

    __CPROVER_assert(pid_valid_here(&pid), "PID_004_valid: the controller stays valid");
    if (status == KEEL_OK) {
        __CPROVER_assert(before.started || (before.error != 0.0f) || (before.setpoint != 0.0f) ||
                             (before.derivative != 0.0f) || (pid.integral == before.integral),
                         "PID_005_fresh: before the first step there is nothing to take over");
    } else {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
