// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_remove close_place
// defines: -DKEEL_QUEUE_CAPACITY=16u
//
// Bounded to a capacity of 16 tasks, with which the solver comes to an end in a minute; the
// contract under WP has no bound.
#include "../common/keel_proof.h"

void keel_queue_remove_harness(void)
{
    keel_queue_t queue;
    const uint32_t position = any_below(CAPACITY);
    const uint32_t i = any_below(CAPACITY);
    keel_queue_t before;
    uint32_t slot;

    any_queue(&queue, position);
    __CPROVER_assume(position < queue.count);
    before = queue;
    slot = queue.order[position];

    keel_queue_remove(&queue, position);

    ASSERT_QUEUE_VALID(&queue, "QUE_005");
    __CPROVER_assert(queue.task[i] != &proof_task, "QUE_007_gone: the task is queued no more");
    __CPROVER_assert(queue.count == (before.count - 1u), "QUE_007_order: one task less");
    __CPROVER_assert(queue.realtime_count ==
                         (before.realtime_count - ((position < before.realtime_count) ? 1u : 0u)),
                     "QUE_007_order: one real-time task less if it was one");
    __CPROVER_assert((queue.order[queue.count] == slot) && (queue.task[slot] == NULL),
                     "QUE_007_freed: its slot is the first free one");
    __CPROVER_assert((i >= position) || (queue.order[i] == before.order[i]),
                     "QUE_007_order: the slots before it stay");
    __CPROVER_assert((i < position) || (i >= queue.count) ||
                         (queue.order[i] == before.order[i + 1u]),
                     "QUE_007_order: those behind it move up by one");
    __CPROVER_assert((i <= queue.count) || (queue.order[i] == before.order[i]),
                     "QUE_007_order: the free ones stay");
    __CPROVER_assert((i == slot) || (queue.task[i] == before.task[i]),
                     "QUE_007_frame: no other slot is freed");
    __CPROVER_assert(slot_same(&queue, &before, i), "QUE_007_frame: what is in a slot stays");
}
