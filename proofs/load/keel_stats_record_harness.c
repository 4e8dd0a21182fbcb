// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/load.c
// covers: keel_stats_record count_one
#include "../common/keel_proof.h"

/* The record of one run, field by field (stats_recorded); the promotions stay. */
static keel_stats_t recorded(const keel_stats_t *before, uint32_t elapsed_us, uint32_t budget_us)
{
    keel_stats_t after = *before;

    after.last_us = elapsed_us;
    after.longest_us = (before->longest_us < elapsed_us) ? elapsed_us : before->longest_us;
    if ((budget_us < elapsed_us) && (before->overruns != UINT16_MAX)) {
        after.overruns++;
    }
    if ((before->runs != UINT32_MAX) && (elapsed_us <= (UINT64_MAX - before->total_us))) {
        after.runs++;
        after.total_us += elapsed_us;
    }
    return after;
}

void keel_stats_record_harness(void)
{
    keel_stats_t stats = nondet_stats();
    keel_stats_t expected;
    const keel_stats_t before = stats;
    const uint32_t elapsed_us = nondet_u32();
    const uint32_t budget_us = nondet_u32();
    const bool overrun = elapsed_us > budget_us;
    const bool open = (before.runs < UINT32_MAX) &&
                      (((unsigned __CPROVER_bitvector[65])before.total_us + elapsed_us) <=
                       UINT64_MAX);

    keel_stats_record(&stats, elapsed_us, budget_us);

    __CPROVER_assert(stats.last_us == elapsed_us, "LOD_001_last: the last run is this one");
    __CPROVER_assert((stats.longest_us >= elapsed_us) && (stats.longest_us >= before.longest_us) &&
                         ((stats.longest_us == elapsed_us) ||
                          (stats.longest_us == before.longest_us)),
                     "LOD_001_longest: the longest run is the longer of both");
    __CPROVER_assert((!overrun && (stats.overruns == before.overruns)) ||
                         (overrun && (before.overruns == UINT16_MAX) &&
                          (stats.overruns == UINT16_MAX)) ||
                         (overrun && ((uint32_t)stats.overruns == (before.overruns + 1u))),
                     "LOD_002: a run longer than the budget is counted, up to the limit");
    if (open) {
        __CPROVER_assert((stats.runs > before.runs) && ((stats.runs - 1u) == before.runs),
                         "LOD_003_runs: the run is counted");
        __CPROVER_assert((stats.total_us >= before.total_us) &&
                             ((stats.total_us - before.total_us) == elapsed_us),
                         "LOD_003_total: its time is added");
    } else {
        __CPROVER_assert((stats.runs == before.runs) && (stats.total_us == before.total_us),
                         "LOD_003_frozen: a full mean is kept");
    }
    expected = recorded(&before, elapsed_us, budget_us);
    __CPROVER_assert(stats_same(&stats, &expected), "LOD_003_recorded: all of the record at once");
    __CPROVER_assert(stats.promotions == before.promotions, "LOD_001_frame: promotions stay");
}
