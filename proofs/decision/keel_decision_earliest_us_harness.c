// cbmc: --unwind 34
// sources: src/rtos/decision.c src/rtos/priority.c
// covers: keel_decision_earliest_us
#include "../common/decision_contracts.h"

void keel_decision_earliest_us_harness(void)
{
    keel_queue_t queue;
    const uint32_t i = any_below(CAPACITY);
    uint64_t earliest_us;
    keel_queue_t before;

    any_queue(&queue, CAPACITY);
    before = queue;

    earliest_us = keel_decision_earliest_us(&queue);

    __CPROVER_assert((i >= queue.realtime_count) ||
                         (earliest_us <= queue.release_us[queue.order[i]]),
                     "DEC_002_earliest: no real-time task is released before it");
    __CPROVER_assert(is_some_release(&queue, 0u, queue.realtime_count, earliest_us),
                     "DEC_002_earliest: it is a real-time task's release, or never");
    __CPROVER_assert(queue_same(&queue, &before, i), "DEC_002_frame: nothing is written");
}
