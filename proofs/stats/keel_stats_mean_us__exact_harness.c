// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/stats.c
// covers: keel_stats_mean_us
//
// Bounded to totals below 2^10 us and 2^4 runs, where the solver comes to the end of the
// division; the harness of equality with the model has no such bound, nor has the contract under
// WP.
#include "../common/keel_proof.h"

void keel_stats_mean_us__exact_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t before;
    uint64_t mean_us;

    stats.total_us = any_bits64(10u);
    stats.runs = any_bits(4u);
    before = stats;

    mean_us = keel_stats_mean_us(&stats);

    if (stats.runs == 0u) {
        __CPROVER_assert(mean_us == 0u, "STS_005_none: 0 before the first run");
    } else {
        __CPROVER_assert(mean_us <= 0x3FFu, "STS_005_mean: at most the total");
        __CPROVER_assert((mean_us * stats.runs) <= stats.total_us,
                         "STS_005_mean: so many runs of the mean take no longer than the total");
        __CPROVER_assert(stats.total_us < ((mean_us + 1u) * stats.runs),
                         "STS_005_mean: with a microsecond more each they would");
    }
    __CPROVER_assert(stats_same(&stats, &before), "STS_005_frame: nothing changed");
}
