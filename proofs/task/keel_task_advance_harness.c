// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/task.c
// covers: keel_task_advance add_saturating
//
// Bounded to periods up to 2^4 us, and up to 2^8 us of lateness, where the solver comes to the end
// of the division; the contract under WP has no such bound.
#include "../common/keel_proof.h"

void keel_task_advance_harness(void)
{
    const uint64_t late_us = any_bits64(8u);
    uint64_t now_us;
    uint32_t period_us;
    keel_task_t before;
    keel_task_config_t config_before;
    const keel_task_t *task;

    any_task(0u, nondet_bool());
    proof_config[0]->period_us = any_bits(4u) + 1u;
    proof_task[0]->release_us = any_bits64(62u);
    task = proof_task[0];
    now_us = task->release_us + late_us;
    __CPROVER_assume(now_us <= KEEL_CLOCK_TIME_LIMIT_US);
    before = *task;
    config_before = *proof_config[0];
    period_us = config_before.period_us;
    __CPROVER_assume((0u < period_us) && (period_us < KEEL_PERIOD_LIMIT_US));
    __CPROVER_assume((task->release_us <= now_us) && (now_us <= KEEL_CLOCK_TIME_LIMIT_US));

    keel_task_advance(proof_task[0], now_us);

    __CPROVER_assert(now_us < task->release_us, "TSK_004_next: the next release lies ahead");
    __CPROVER_assert(task->release_us <= (now_us + period_us), "TSK_004_next: by at most a period");
    __CPROVER_assert((now_us >= (before.release_us + period_us)) ||
                         ((task->release_us == (before.release_us + period_us)) &&
                          (task->skipped == before.skipped)),
                     "TSK_004_on_time: within its period the grid moves on by one, none skipped");
    /* Exact: with the next release ahead by at most a period, the grid point is the only one. */
    __CPROVER_assert((task->skipped == UINT16_MAX) ||
                         ((task->release_us - before.release_us) ==
                          (((uint64_t)task->skipped - before.skipped + 1u) * period_us)),
                     "TSK_004_grid: the release moves on by whole periods, the skipped and one");
    __CPROVER_assert((task->skipped >= before.skipped) &&
                         ((task->skipped < UINT16_MAX) ||
                          ((before.skipped + (late_us / period_us)) >= UINT16_MAX)),
                     "TSK_004_skipped: the count stops at its limit, and only there");
    __CPROVER_assert((task->config == before.config) && stats_same(&task->stats, &before.stats) &&
                         config_same(proof_config[0], &config_before),
                     "TSK_004_frame: statistics and declaration stay");
}
