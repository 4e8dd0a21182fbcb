// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_other competing_priority priority_of fits
//
// Bounded to a queue of one real-time task and three others, with periods, budgets and runs up to
// 2^4 us and times below 2^6 us: eq. 3 divides. The contract under WP has no such bound.
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

#define MOST 4u

/* The dynamic priority with which a task competes: 0 when it is not eligible. */
static uint32_t competing(const keel_task_t *task, uint64_t now_us, uint64_t slack_us,
                          uint64_t guard_us)
{
    const keel_task_config_t *const config = task->config;
    uint32_t priority;

    if (task->release_us > now_us) {
        return 0u;
    }
    priority = dynamic_priority(config->priority, (now_us - task->release_us) + config->period_us,
                                config->period_us);
    if ((priority == 16u) || (((guard_us + config->budget_us) <= slack_us) &&
                              ((guard_us + task->stats.longest_us) <= slack_us))) {
        return priority;
    }
    return 0u;
}

void keel_decision_other_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = any_bits64(6u);
    const uint64_t slack_us = nondet_bool() ? any_bits64(6u) : KEEL_TIME_NEVER_US;
    const uint32_t guard_us = any_bits(4u);
    const uint32_t i = any_below(MOST);
    uint32_t priority[MOST];
    uint32_t chosen;

    queue_of(&queue, 1u, MOST);
    narrow_tasks(MOST, 4u, 6u);
    for (uint32_t k = 0u; k < MOST; k++) {
        priority[k] = ((queue.realtime_count <= k) && (k < queue.count))
                          ? competing(proof_task[k], now_us, slack_us, guard_us)
                          : 0u;
    }

    chosen = keel_decision_other(&queue, now_us, slack_us, guard_us);

    __CPROVER_assert((queue.realtime_count <= chosen) && (chosen <= queue.count),
                     "DEC_003_range: the index is that of another task, or count");
    if (chosen < queue.count) {
        __CPROVER_assert(priority[chosen] > 0u, "DEC_003_eligible: the chosen task is eligible");
        __CPROVER_assert(priority[i] <= priority[chosen],
                         "DEC_003_highest: no eligible task has a higher dynamic priority");
        __CPROVER_assert((i >= chosen) || (priority[i] < priority[chosen]),
                         "DEC_003_first: nor one before it the same");
    } else {
        __CPROVER_assert(priority[i] == 0u, "DEC_003_none: none is eligible");
    }
}
