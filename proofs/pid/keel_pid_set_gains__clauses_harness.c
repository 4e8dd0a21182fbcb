// SPDX-License-Identifier: Apache-2.0
// cbmc: --refine
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c
// covers: keel_pid_set_gains direct_terms are_gains is_gain
//
// Any valid controller, any bit pattern for the gains: they are taken as they are, or refused. That
// the controller stays valid is in keel_pid_set_gains__valid_harness.
#include "pid_proof.h"

void keel_pid_set_gains__clauses_harness(void)
{
    const keel_pid_gains_t gains = nondet_gains();
    keel_pid_t pid = any_pid();
    const keel_pid_t before = pid;
    const keel_status_t status = keel_pid_set_gains(&pid, &gains);

    __CPROVER_assert((status == KEEL_OK) || (status == KEEL_ERR_GAIN),
                     "PID_004_status: taken or refused");
    __CPROVER_assert((status == KEEL_OK) == gains_here(&gains),
                     "PID_004_ok: taken exactly when all are in range");
    __CPROVER_assert((status == KEEL_OK) ||
                         (pid_gains_same(&pid.config.gains, &before.config.gains) &&
                          float_same(pid.integral, before.integral)),
                     "PID_004_unchanged: what is refused changes neither gains nor integral");
    __CPROVER_assert((status != KEEL_OK) || pid_gains_same(&pid.config.gains, &gains),
                     "PID_005_taken: from now on these are the gains");
}
