// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/pid.c src/flight/filter.c specs/model/pid.c specs/model/filter.c
// covers: keel_pid_set_gains direct_terms are_gains is_gain model_pid_set_gains without_integral
//
// Any controller at all, any bit pattern for the gains: the same as the model's, bit for bit. The
// solver sees that both compute the same only where nothing else is asked: overflow and NaN are
// checked in keel_pid_set_gains__valid_harness.
#include "../../specs/model/pid.h"
#include "pid_proof.h"

void keel_pid_set_gains_harness(void)
{
    keel_pid_gains_t gains = nondet_gains();
    const keel_pid_gains_t before = gains;
    keel_pid_t pid = any_pid_at_all();
    keel_pid_t model = pid;
    const keel_status_t status = keel_pid_set_gains(&pid, &gains);

    __CPROVER_assert(status == model_pid_set_gains(&model, &before),
                     "PID_004_model: taken or refused as the model says");
    __CPROVER_assert(pid_same(&pid, &model), "PID_005_model: every field is what the model says");
    __CPROVER_assert(pid_gains_same(&gains, &before), "PID_004_frame: the gains are not written");
}
