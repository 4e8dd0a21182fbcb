// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_init
//
// Any bit pattern for all of a configuration, rate and cut-off included: what stands in for the
// function elsewhere. Overflow and NaN are checked in keel_pid_init__valid_harness.
#include "../common/pid_contracts.h"

void keel_pid_init__any_harness(void)
{
    const keel_pid_config_t config = nondet_pid_config();
    keel_pid_t pid = any_pid_at_all();
    keel_status_t status;

    __CPROVER_assume(keel_pid_init_may());

    status = keel_pid_init(&pid, &config);

    __CPROVER_assert(keel_pid_init_does(status, &pid, &config),
                     "PID_002_any: what is made is valid, and of this configuration");
}
