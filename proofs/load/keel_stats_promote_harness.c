// cbmc: --unwind 2
// sources: src/rtos/load.c specs/model/load.c
// covers: keel_stats_promote count_one model_stats_promote
#include "../../specs/model/load.h"
#include "../common/keel_proof.h"

void keel_stats_promote_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t model = stats;

    keel_stats_promote(&stats);
    model_stats_promote(&model);

    __CPROVER_assert(stats_same(&stats, &model),
                     "LOD_004_model: every field is what the model says");
}
