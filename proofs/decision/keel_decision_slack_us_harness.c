// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_slack_us time_to_release_us
//
// Bounded to queues of at most MOST tasks, with times of full width; the contract under WP has no
// such bound.
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

#define MOST 3u

static uint64_t time_to(const keel_task_t *task, uint64_t now_us)
{
    return (task->release_us > now_us) ? (task->release_us - now_us) : 0u;
}

void keel_decision_slack_us_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = nondet_u64();
    const uint32_t i = any_below(MOST);
    bool met = false;
    uint64_t slack_us;

    any_queue_of(&queue, MOST);

    slack_us = keel_decision_slack_us(&queue, now_us);

    for (uint32_t k = 0u; k < MOST; k++) {
        met = met || ((k < queue.realtime_count) && (slack_us == time_to(proof_task[k], now_us)));
        if ((i == k) && (k < queue.realtime_count)) {
            __CPROVER_assert(slack_us <= time_to(proof_task[k], now_us),
                             "DEC_002_bound: the slack ends with the next real-time release");
        }
    }
    __CPROVER_assert(met || (slack_us == KEEL_TIME_NEVER_US),
                     "DEC_002_exact: the slack is the time to a real-time release");
    __CPROVER_assert((queue.realtime_count > 0u) || (slack_us == KEEL_TIME_NEVER_US),
                     "DEC_002_none: endless without real-time tasks");
}
