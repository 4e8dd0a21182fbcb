// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/load.c
// covers: keel_stats_promote count_one
#include "../common/keel_proof.h"

void keel_stats_promote_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t expected = stats;

    if (expected.promotions < UINT16_MAX) {
        expected.promotions++;
    }

    keel_stats_promote(&stats);

    __CPROVER_assert(stats.promotions == expected.promotions,
                     "LOD_004: a promotion is counted, up to the limit");
    __CPROVER_assert(stats_same(&stats, &expected), "LOD_004_frame: the rest stays");
}
