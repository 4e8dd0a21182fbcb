// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_init are_gains are_limits is_limit is_gain
//
// Any configuration, any bit pattern in it: what is made is valid, and no operation overflows or
// gives a NaN. The rate and the cut-off are one good pair or a bad one, since
// keel_filter_init__valid_harness has all of them. What the controller is, is in
// keel_pid_init_harness.
#include "../common/unchanged.h"
#include "pid_proof.h"

void keel_pid_init__valid_harness(void)
{
    keel_pid_config_t config = nondet_pid_config();
    keel_pid_t pid = any_pid_at_all();
    const keel_pid_t before = pid;
    keel_status_t status;

    config.rate_hz = nondet_bool() ? 500.0f : -1.0f;
    config.cutoff_hz = nondet_bool() ? 40.0f : 250.0f;

    status = keel_pid_init(&pid, &config);

    if (status == KEEL_OK) {
        __CPROVER_assert(pid_valid_here(&pid), "PID_002_valid: a made controller is valid");
    } else {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
