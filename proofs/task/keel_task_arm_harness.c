// cbmc: --unwind 34
// sources: src/rtos/task.c
// covers: keel_task_arm
#include "../common/keel_proof.h"

void keel_task_arm_harness(void)
{
    const uint64_t start_us = nondet_u64();
    keel_task_config_t config_before;
    const keel_task_t *task;

    any_task(0u, nondet_bool());
    task = proof_task[0];
    config_before = *proof_config[0];
    __CPROVER_assume(start_us <= KEEL_CLOCK_TIME_LIMIT_US);

    keel_task_arm(proof_task[0], start_us);

    __CPROVER_assert(task->release_us == (start_us + config_before.phase_us),
                     "TSK_003_release: the first release is a phase after the start");
    __CPROVER_assert(task->skipped == 0u, "TSK_003_skipped: nothing is skipped yet");
    __CPROVER_assert((task->stats.total_us == 0u) && (task->stats.runs == 0u) &&
                         (task->stats.last_us == 0u) && (task->stats.longest_us == 0u) &&
                         (task->stats.overruns == 0u) && (task->stats.promotions == 0u),
                     "TSK_003_stats: the statistics are clear");
    __CPROVER_assert((task->config == proof_config[0]) &&
                         config_same(proof_config[0], &config_before),
                     "TSK_003_frame: the declaration stays");
}
