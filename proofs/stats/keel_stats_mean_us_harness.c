// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2 --z3
// sources: src/rtos/stats.c specs/model/stats.c
// covers: keel_stats_mean_us model_stats_mean_us
#include "../../specs/model/stats.h"
#include "../common/keel_proof.h"

void keel_stats_mean_us_harness(void)
{
    keel_stats_t stats = nondet_stats();
    const keel_stats_t before = stats;
    const uint64_t mean_us = keel_stats_mean_us(&stats);

    __CPROVER_assert(mean_us == model_stats_mean_us(&before),
                     "STS_005_model: the mean, rounded down, or 0");
    __CPROVER_assert(stats_same(&stats, &before), "STS_005_frame: nothing changes");
}
