// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 12 --z3 --fpa
// checks: assertions
// sources: src/flight/cascade.c src/flight/pid.c src/flight/filter.c
// sources: specs/model/cascade.c specs/model/cascade_parts.c specs/model/pid.c specs/model/filter.c
// covers: keel_cascade_init model_cascade_init
//
// Any bit pattern for all of a configuration. Overflow and NaN are checked in
// keel_cascade_init__valid_harness.
#include "cascade_proof.h"

static keel_cascade_config_t config;
static keel_cascade_t cascade;
static keel_cascade_t model;

void keel_cascade_init_harness(void)
{
    keel_status_t status;

    config = nondet_cascade_config();
    any_cascade(&cascade);
    model = cascade;

    status = keel_cascade_init(&cascade, &config);

    __CPROVER_assert(status == model_cascade_init(&model, &config),
                     "CAS_002_taken: taken or refused as the model says");
    __CPROVER_assert(cascade_same(&cascade, &model),
                     "CAS_002_model: every field is what the model says");
}
