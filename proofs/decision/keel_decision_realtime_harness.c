// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_realtime
//
// Bounded to queues of at most MOST tasks, with times of full width; the contract under WP has no
// such bound.
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

#define MOST 16u

void keel_decision_realtime_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = nondet_u64();
    const uint32_t i = any_below(MOST);
    uint32_t from;
    uint32_t to;
    uint32_t found;

    any_queue_of(&queue, MOST);
    to = any_below(queue.realtime_count + 1u);
    from = any_below(to + 1u);

    found = keel_decision_realtime(&queue, from, to, now_us);

    __CPROVER_assert((from <= found) && (found <= to), "DEC_001_range: the index lies in the part");
    if ((i == found) && (i < to)) {
        __CPROVER_assert(queue.task[i]->release_us <= now_us, "DEC_001_due: the task is due");
    }
    if ((from <= i) && (i < found)) {
        __CPROVER_assert(queue.task[i]->release_us > now_us, "DEC_001_first: none before it is");
    }
}
