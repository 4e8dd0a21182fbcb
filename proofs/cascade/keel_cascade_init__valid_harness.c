// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --no-array-field-sensitivity --external-sat-solver cadical
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_check keel_pid_init
// covers: keel_cascade_init make_axis command_nothing
//
// Any bit pattern for all of a configuration: what is made is valid, but for the fence, which is in
// keel_cascade_init__fence_harness; a refusal changes nothing. That no operation overflows or gives
// a NaN is in keel_cascade_init_harness. By hand: a controller is made of what keel_cascade_check
// has made one of before. Whether it can be made follows from its configuration alone
// (keel_pid_init_harness), so it can.
#include "cascade_proof.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;
static keel_cascade_t before;

keel_status_t keel_cascade_check_stand_in(const keel_cascade_config_t *whole, uint32_t axis)
{
    const keel_status_t status = nondet_bool() ? KEEL_OK : KEEL_ERR_LIMITS;

    __CPROVER_assert(keel_cascade_check_may(), "precondition: keel_cascade_check");
    __CPROVER_assume(keel_cascade_check_does(status, whole, axis));
    return status;
}

keel_status_t keel_pid_init_stand_in(keel_pid_t *pid, const keel_pid_config_t *of)
{
    __CPROVER_assert(keel_pid_init_may(), "precondition: keel_pid_init");
    *pid = any_pid_at_all();
    __CPROVER_assume(keel_pid_init_does(KEEL_OK, pid, of));
    return KEEL_OK;
}

void keel_cascade_init__valid_harness(void)
{
    keel_status_t status;

    config = nondet_cascade_config();
    any_cascade(&cascade);
    before = cascade;

    status = keel_cascade_init(&cascade, &config);

    if (status == KEEL_OK) {
        __CPROVER_assert(axes_valid_here(&cascade), "CAS_002_valid: what is made is valid");
        __CPROVER_assert(cascade.axes == 0u, "CAS_002_still: the mode flies none");
        for (uint32_t i = 0u; i < AXES; i++) {
            __CPROVER_assert(!cascade.axis[i].running, "CAS_002_still: no axis runs");
        }
    } else {
        __CPROVER_assert(cascade_same(&cascade, &before),
                         "CAS_002_kept: a refusal changes nothing");
    }
}
