// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// sources: src/rtos/deviation.c specs/model/deviation.c
// covers: keel_deviation_variance_us2 model_deviation_variance_us2
#include "../../specs/model/deviation.h"
#include "deviation_proof.h"

void keel_deviation_variance_us2_harness(void)
{
    keel_deviation_t deviation = {
        .sum_us2 = nondet_u64(), .start_us = nondet_u64(), .starts = nondet_u32()};
    const keel_deviation_t before = deviation;
    const uint64_t variance_us2 = keel_deviation_variance_us2(&deviation);

    __CPROVER_assert(variance_us2 == model_deviation_variance_us2(&before),
                     "DEV_003_model: the mean square, rounded down, or 0");
    __CPROVER_assert(deviation_same(&deviation, &before), "DEV_003_frame: nothing changes");
}
