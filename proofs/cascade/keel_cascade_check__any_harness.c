// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 13 --external-sat-solver cadical
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// covers: keel_cascade_check
//
// Any bit pattern of the cascade's own numbers and of what limits the controllers' outputs; the
// rest of these is good, as keel_pid_init has harnesses of its own: what stands in for the function
// elsewhere. One axis after another, so that a rate is a number to the solver.
#include "cascade_points.h"

static keel_cascade_config_t config;

void keel_cascade_check__any_harness(void)
{
    const uint32_t none = nondet_uint();
    const keel_cascade_config_t any = nondet_cascade_config();

    __CPROVER_assume(keel_cascade_check_may());
    good_config(&config);
    config.hover = any.hover;
    config.acceleration = any.acceleration;
    config.braking = any.braking;
    config.reaction_s = any.reaction_s;
    for (uint32_t i = 0u; i < AXES; i++) {
        config.reach[i] = any.reach[i];
        config.pid[i].output_min = any.pid[i].output_min;
        config.pid[i].output_max = any.pid[i].output_max;
    }
    __CPROVER_assume(none >= AXES);
    for (uint32_t i = 0u; i <= AXES; i++) {
        const uint32_t axis = (i < AXES) ? i : none;
        const keel_status_t status = keel_cascade_check(&config, axis);

        __CPROVER_assert(keel_cascade_check_does(status, &config, axis),
                         "CAS_001_any: what is taken is within its ranges");
    }
}
