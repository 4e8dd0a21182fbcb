// SPDX-License-Identifier: Apache-2.0
// cbmc: --z3 --fpa
// checks: assertions
// sources: src/flight/filter.c specs/model/filter.c
// covers: keel_filter_init set_coefficients tangent model_filter_init tan_of
//
// Any bit pattern for both frequencies: the same as the model's, bit for bit. The solver sees that
// both compute the same only where nothing else is asked: overflow and NaN are checked in
// keel_filter_init__any_harness.
#include "../../specs/model/filter.h"
#include "../common/keel_flight_proof.h"

void keel_filter_init_harness(void)
{
    const float rate_hz = nondet_float();
    const float cutoff_hz = nondet_float();
    keel_filter_t filter = nondet_filter();
    keel_filter_t model = filter;
    const keel_status_t status = keel_filter_init(&filter, rate_hz, cutoff_hz);

    __CPROVER_assert(status == model_filter_init(&model, rate_hz, cutoff_hz),
                     "FLT_001_model: taken or refused as the model says");
    __CPROVER_assert(filter_same(&filter, &model),
                     "FLT_002_model: coefficients and states are what the model says");
}
