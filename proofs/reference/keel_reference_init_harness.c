// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/reference.c specs/model/reference.c
// covers: keel_reference_init are_expos is_expo are_dead_bands is_dead_band
// covers: are_stick_limits is_stick_limit curve_of model_reference_init
//
// Any bit pattern for all of a configuration: the same as the model's, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_reference_init__valid_harness.
#include "../../specs/model/reference.h"
#include "reference_proof.h"

void keel_reference_init_harness(void)
{
    keel_reference_config_t config = nondet_reference_config();
    const keel_reference_config_t before = config;
    keel_reference_t reference = nondet_reference();
    keel_reference_t model = reference;
    const keel_status_t status = keel_reference_init(&reference, &config);

    __CPROVER_assert(status == model_reference_init(&model, &before),
                     "REF_001_model: taken or refused as the model says");
    __CPROVER_assert(reference_same(&reference, &model),
                     "REF_002_model: every field is what the model says");
    __CPROVER_assert(config_same(&config, &before),
                     "REF_002_frame: the configuration is not written");
}
