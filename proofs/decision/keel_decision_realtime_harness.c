// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_realtime
#include "../common/keel_proof.h"
#include "keel/rtos/decision.h"

void keel_decision_realtime_harness(void)
{
    keel_queue_t queue;
    const uint64_t now_us = nondet_u64();
    const uint32_t i = any_below(CAPACITY);
    uint32_t from;
    uint32_t to;
    uint32_t found;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    to = any_below(queue.realtime_count + 1u);
    from = any_below(to + 1u);
    before = queue;

    found = keel_decision_realtime(&queue, from, to, now_us);

    __CPROVER_assert((from <= found) && (found <= to), "DEC_001_range: it lies in the part");
    if (i == found) {
        __CPROVER_assert((i == to) || (queue.release_us[queue.order[i]] <= now_us),
                         "DEC_001_due: the task is due");
    }
    __CPROVER_assert((i < from) || (found <= i) || (queue.release_us[queue.order[i]] > now_us),
                     "DEC_001_first: none before it is");
    __CPROVER_assert(queue_same(&queue, &before, i), "DEC_001_frame: nothing is written");
}
