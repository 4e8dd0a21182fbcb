// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/pid.c
// replaces: keel_filter_init
// covers: keel_pid_init are_gains are_limits is_limit is_gain
//
// Any bit pattern for all of a configuration, rate and cut-off included: what is made is valid, and
// no operation overflows or gives a NaN; also what stands in for the function elsewhere. What the
// controller is, is in keel_pid_init_harness.
#include "../common/filter_contracts.h"
#include "../common/pid_contracts.h"
#include "../common/unchanged.h"

keel_status_t keel_filter_init_stand_in(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    const keel_filter_t before = *filter;
    const keel_status_t refusal = nondet_bool() ? KEEL_ERR_RATE : KEEL_ERR_CUTOFF;
    const keel_status_t status = nondet_bool() ? KEEL_OK : refusal;

    __CPROVER_assert(keel_filter_init_may(), "precondition: keel_filter_init");
    *filter = nondet_filter();
    __CPROVER_assume(keel_filter_init_does(status, filter, &before, rate_hz));
    (void)cutoff_hz;
    return status;
}

void keel_pid_init__any_harness(void)
{
    const keel_pid_config_t config = nondet_pid_config();
    keel_pid_t pid = any_pid_at_all();
    const keel_pid_t before = pid;
    keel_status_t status;

    __CPROVER_assume(keel_pid_init_may());

    status = keel_pid_init(&pid, &config);

    __CPROVER_assert(keel_pid_init_does(status, &pid, &config),
                     "PID_002_any: what is made is valid, and of this configuration");
    if (status == KEEL_OK) {
        __CPROVER_assert(pid_valid_here(&pid), "PID_002_valid: a made controller is valid");
    } else {
        __CPROVER_assert(unchanged(&pid, &before, sizeof(pid)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
