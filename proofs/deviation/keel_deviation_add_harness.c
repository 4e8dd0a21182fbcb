// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// checks: assertions
// sources: src/rtos/deviation.c specs/model/deviation.c
// covers: keel_deviation_add distance_us model_deviation_add
//
// For all numbers. The solver sees that both compute the same only where nothing else is asked:
// overflow is checked in keel_deviation_add__exact_harness, and for all numbers by WP.
#include "../../specs/model/deviation.h"
#include "deviation_proof.h"

void keel_deviation_add_harness(void)
{
    keel_deviation_t deviation = {
        .sum_us2 = nondet_u64(), .start_us = nondet_u64(), .starts = nondet_u32()};
    keel_deviation_t model = deviation;
    const uint64_t start_us = nondet_u64();
    const uint32_t period_us = nondet_u32();
    keel_status_t status;

    __CPROVER_assume((deviation.starts == 0u) || (deviation.start_us <= start_us));

    status = keel_deviation_add(&deviation, start_us, period_us);

    __CPROVER_assert(status == model_deviation_add(&model, start_us, period_us),
                     "DEV_002_model: taken or refused as the model says");
    __CPROVER_assert(deviation_same(&deviation, &model),
                     "DEV_001_model: sum, start and count are what the model says");
}
