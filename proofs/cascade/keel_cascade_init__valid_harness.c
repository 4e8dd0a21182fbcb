// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// covers: keel_cascade_init make_axis command_nothing keel_cascade_check
//
// Any bit pattern for the cascade's own numbers, and for the roll axis' controller but for its
// rate and cut-off; these and the other controllers are chosen ones, since all go through the same
// functions. What is made is valid, a refusal changes nothing, and no operation overflows or gives
// a NaN.
#include "../common/unchanged.h"
#include "cascade_points.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;
static keel_cascade_t before;

void keel_cascade_init__valid_harness(void)
{
    keel_status_t status;

    good_config(&config);
    for (uint32_t i = 0u; i < AXES; i++) {
        config.reach[i] = nondet_float();
    }
    config.pid[KEEL_CASCADE_ROLL] = nondet_pid_config();
    config.pid[KEEL_CASCADE_ROLL].rate_hz = 500.0f;
    config.pid[KEEL_CASCADE_ROLL].cutoff_hz = 40.0f;
    config.hover = nondet_float();
    config.acceleration = nondet_float();
    config.braking = nondet_float();
    config.reaction_s = nondet_float();
    any_cascade(&cascade);
    before = cascade;

    status = keel_cascade_init(&cascade, &config);

    if (status == KEEL_OK) {
        const uint32_t axis = nondet_uint();

        __CPROVER_assume(axis < AXES);
        __CPROVER_assert(cascade_valid_here(&cascade), "CAS_002_valid: what is made is valid");
        __CPROVER_assert((cascade.axes == 0u) && !cascade.axis[axis].running,
                         "CAS_002_still: no axis runs");
    } else {
        __CPROVER_assert(unchanged(&cascade, &before, sizeof(cascade)),
                         "STA_001_kept: a refusal changes nothing");
    }
}
