// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/deviation.c
// covers: keel_deviation_variance_us2
//
// Bounded to sums below 2^10 us^2 and 2^4 starts, where the solver comes to the end of the
// division; the harness of equality with the model has no such bound, nor has the contract under
// WP.
#include "deviation_proof.h"

void keel_deviation_variance_us2__exact_harness(void)
{
    keel_deviation_t deviation = {.sum_us2 = any_bits64(10u), .starts = any_bits(4u)};
    uint64_t variance;

    deviation.start_us = nondet_u64();

    variance = keel_deviation_variance_us2(&deviation);

    if (deviation.starts < 2u) {
        __CPROVER_assert(variance == 0u, "DEV_003_none: 0 before the second start");
    } else {
        __CPROVER_assert(variance <= 0x3FFu, "DEV_003_mean: at most the sum");
        __CPROVER_assert((variance * (deviation.starts - 1u)) <= deviation.sum_us2,
                         "DEV_003_mean: the mean square, not more");
        __CPROVER_assert(deviation.sum_us2 < ((variance + 1u) * (deviation.starts - 1u)),
                         "DEV_003_mean: rounded down");
    }
}
