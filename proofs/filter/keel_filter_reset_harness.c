// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/flight/filter.c specs/model/filter.c
// covers: keel_filter_reset is_sample model_filter_reset sample_valid
#include "../../specs/model/filter.h"
#include "../common/filter_contracts.h"
#include "../common/unchanged.h"

void keel_filter_reset_harness(void)
{
    const float value = nondet_float();
    keel_filter_t filter;
    keel_filter_t model;
    keel_filter_t before;
    keel_status_t status;

    any_filter(&filter);
    model = filter;
    before = filter;
    __CPROVER_assume(keel_filter_reset_may(&filter));

    status = keel_filter_reset(&filter, value);

    __CPROVER_assert(status == model_filter_reset(&model, value),
                     "FLT_004_model: taken or refused as the model says");
    __CPROVER_assert(filter_same(&filter, &model),
                     "FLT_004_model: states and output are what the model says");
    __CPROVER_assert((status == KEEL_OK) || unchanged(&filter, &before, sizeof(filter)),
                     "STA_001_kept: a refusal changes nothing");
    __CPROVER_assert(keel_filter_reset_does(status, &filter, &before, value),
                     "FLT_004_any: what stands in for it elsewhere");
    __CPROVER_assert(filter_valid_here(&filter), "FLT_004_valid: the filter stays valid");
}
