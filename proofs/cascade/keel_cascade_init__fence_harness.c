// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --refine
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// replaces: keel_cascade_check keel_pid_init
// covers: keel_cascade_init
//
// Any bit pattern for all of a configuration: the fence that is made is valid. All else is in
// keel_cascade_init__valid_harness, whose solver does not end on bounds of products.
#include "cascade_proof.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;

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

void keel_cascade_init__fence_harness(void)
{
    config = nondet_cascade_config();
    any_cascade(&cascade);

    if (keel_cascade_init(&cascade, &config) == KEEL_OK) {
        __CPROVER_assert(fence_valid_here(&cascade.fence), "CAS_002_fence: it is valid");
    }
}
