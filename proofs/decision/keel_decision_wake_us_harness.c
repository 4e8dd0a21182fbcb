// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_wake_us next_event_us keel_priority_promotion_age_us
//
// Bounded to a queue of one real-time task and three others, with periods up to 2^4 us and times
// below 2^6 us: the promotion age divides. The contract under WP has no such bound.
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

#define MOST 4u

/* Whether waiting alone can make a task run at a time behind now_us, and not before: there it is
 * released, or promoted if it is released already. */
static bool is_event(const keel_task_t *task, uint64_t now_us, uint64_t event_us)
{
    const uint32_t period_us = task->config->period_us;
    const uint32_t sp = task->config->priority;

    if ((task->release_us > now_us) || (sp == 16u)) {
        return event_us == task->release_us;
    }
    return (event_us >= task->release_us) &&
           (dynamic_priority(sp, (event_us - task->release_us) + period_us, period_us) == 16u) &&
           (dynamic_priority(sp, (event_us - task->release_us) + period_us - 1u, period_us) < 16u);
}

/* Whether a task has nothing to do before a time. */
static bool waits_until(const keel_task_t *task, uint64_t now_us, uint64_t wake_us)
{
    const uint32_t period_us = task->config->period_us;
    const uint32_t sp = task->config->priority;

    if ((task->release_us > now_us) || (sp == 16u)) {
        return wake_us <= task->release_us;
    }
    return (wake_us <= task->release_us) ||
           (dynamic_priority(sp, (wake_us - task->release_us) + period_us - 1u, period_us) < 16u);
}

void keel_decision_wake_us_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = any_bits64(6u);
    bool met = false;
    uint64_t wake_us;

    queue_of(&queue, 1u, MOST);
    narrow_tasks(MOST, 4u, 6u);

    wake_us = keel_decision_wake_us(&queue, now_us);

    for (uint32_t k = 0u; k < MOST; k++) {
        if (k < queue.count) {
            __CPROVER_assert((wake_us < 1024u) && waits_until(proof_task[k], now_us, wake_us),
                             "DEC_004_bound: no task can run earlier");
            met = met || is_event(proof_task[k], now_us, wake_us);
        }
    }
    __CPROVER_assert(met || (wake_us == KEEL_TIME_NEVER_US),
                     "DEC_004_exact: it is a release or a promotion of some task");
    __CPROVER_assert((queue.count > 0u) || (wake_us == KEEL_TIME_NEVER_US),
                     "DEC_004_never: never with no task");
}
