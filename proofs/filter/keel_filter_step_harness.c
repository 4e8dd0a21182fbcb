// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/filter.c specs/model/filter.c
// covers: keel_filter_step is_sample model_filter_step sample_valid
//
// Any filter at all, any bit pattern: the same as the model's step, bit for bit. The solver sees
// that both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_filter_step__any_harness.
#include "../../specs/model/filter.h"
#include "../common/keel_flight_proof.h"

void keel_filter_step_harness(void)
{
    const float input = nondet_float();
    keel_filter_t filter = nondet_filter();
    keel_filter_t model = filter;
    const keel_status_t status = keel_filter_step(&filter, input);

    __CPROVER_assert(status == model_filter_step(&model, input),
                     "FLT_009_model: taken or refused as the model says");
    __CPROVER_assert(filter_same(&filter, &model),
                     "FLT_006_model: states and output are what the model says");
}
