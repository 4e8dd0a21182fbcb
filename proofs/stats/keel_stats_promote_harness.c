// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 2
// sources: src/rtos/stats.c specs/model/stats.c
// covers: keel_stats_promote count_one model_stats_promote
#include "../../specs/model/stats.h"
#include "../common/keel_proof.h"

void keel_stats_promote_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t model = stats;

    keel_stats_promote(&stats);
    model_stats_promote(&model);

    __CPROVER_assert(stats_same(&stats, &model),
                     "STS_004_model: every field is what the model says");
}
