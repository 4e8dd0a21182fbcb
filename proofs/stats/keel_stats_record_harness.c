// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/stats.c specs/model/stats.c
// covers: keel_stats_record count_one remember_overrun count_down model_stats_record
#include "../../specs/model/stats.h"
#include "../common/stats_contracts.h"

void keel_stats_record_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t model = stats;
    const uint32_t elapsed_us = nondet_u32();
    const uint32_t budget_us = nondet_u32();

    model_stats_record(&model, elapsed_us, budget_us);
    __CPROVER_assume(keel_stats_record_may(&stats));
    keel_stats_record(&stats, elapsed_us, budget_us);

    __CPROVER_assert(keel_stats_record_does(&stats, &model),
                     "STS_003_model: every field is what the model says");
}
