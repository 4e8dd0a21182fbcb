// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/pid.c
// replaces: keel_filter_init
// covers: keel_pid_init are_gains are_limits is_limit is_gain
//
// Any bit pattern for all of a configuration, rate and cut-off included: the first fault is told,
// in the order of the contract. The low-pass is any that its contract allows; it is refused as
// keel_filter_init__clauses_harness proves.
#include "../common/filter_contracts.h"
#include "../common/filter_refusals.h"
#include "../common/pid_contracts.h"

keel_status_t keel_filter_init_stand_in(keel_filter_t *filter, float rate_hz, float cutoff_hz)
{
    const keel_filter_t before = *filter;
    const keel_status_t status = filter_init_answer(rate_hz, cutoff_hz);

    __CPROVER_assert(keel_filter_init_may(), "precondition: keel_filter_init");
    *filter = nondet_filter();
    __CPROVER_assume(keel_filter_init_does(status, filter, &before, rate_hz));
    return status;
}

void keel_pid_init__clauses_harness(void)
{
    const keel_pid_config_t config = nondet_pid_config();
    const bool gains = gains_here(&config.gains);
    const bool limits = limits_here(&config);
    const bool rate = filter_rate_here(config.rate_hz);
    const bool cutoff = filter_cutoff_here(config.rate_hz, config.cutoff_hz);
    keel_pid_t pid = any_pid_at_all();
    const keel_pid_t before = pid;
    const keel_status_t status = keel_pid_init(&pid, &config);

    __CPROVER_assert(gains || (status == KEEL_ERR_GAIN), "PID_001_gains: a bad gain is refused");
    __CPROVER_assert(!gains || limits || (status == KEEL_ERR_LIMITS),
                     "PID_001_limits: then a bad limit");
    __CPROVER_assert(!gains || !limits || rate || (status == KEEL_ERR_RATE),
                     "PID_001_rate: then a bad rate");
    __CPROVER_assert(!gains || !limits || !rate || cutoff || (status == KEEL_ERR_CUTOFF),
                     "PID_001_cutoff: then a bad cut-off");
    __CPROVER_assert((status == KEEL_OK) || pid_same(&pid, &before),
                     "PID_001_unchanged: what is refused changes nothing");
    __CPROVER_assert((status != KEEL_OK) || (pid_valid_here(&pid) && !pid.started),
                     "PID_002_valid: what is made is valid, and waits for its first step");
}
