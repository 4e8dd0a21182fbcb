// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_advance add_saturating
//
// A task that is less than a period late, with numbers of their full width.
#include "../common/keel_proof.h"
#include "../common/queue_contracts.h"

void keel_queue_advance__on_time_harness(void)
{
    keel_queue_t queue = nondet_queue();
    const uint32_t slot = any_below(CAPACITY);
    const uint32_t i = any_below(CAPACITY);
    const uint64_t now_us = nondet_u64();
    keel_queue_t before;

    __CPROVER_assume(keel_queue_advance_may(&queue, slot, now_us));
    __CPROVER_assume((now_us - queue.release_us[slot]) < queue.period_us[slot]);
    before = queue;

    keel_queue_advance(&queue, slot, now_us);

    __CPROVER_assert(keel_queue_advance_does(&before, &queue, slot, now_us, i),
                     "QUE_009_on_time: the next release is a period behind the last");
}
