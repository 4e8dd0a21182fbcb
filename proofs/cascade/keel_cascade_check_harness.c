// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// covers: keel_cascade_check model_cascade_check
//
// Any bit pattern of a configuration, any axis. Overflow and NaN are checked in
// keel_cascade_check__any_harness.
#include "cascade_proof.h"

void keel_cascade_check_harness(void)
{
    static keel_cascade_config_t config;
    const uint32_t axis = nondet_uint();

    config = nondet_cascade_config();

    __CPROVER_assert(keel_cascade_check(&config, axis) == model_cascade_check(&config, axis),
                     "CAS_001_model: taken or refused as the model says");
}
