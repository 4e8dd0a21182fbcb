// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_init
#include "../common/keel_proof.h"

void keel_queue_init_harness(void)
{
    keel_queue_t queue = nondet_queue();
    const uint32_t x = any_below(CAPACITY);
    const keel_queue_t before = queue;

    keel_queue_init(&queue);

    ASSERT_QUEUE_VALID(&queue, "QUE_001_valid");
    __CPROVER_assert((queue.count == 0u) && (queue.realtime_count == 0u),
                     "QUE_001_empty: it holds no task");
    __CPROVER_assert(queue.task[x] == NULL, "QUE_001_empty: no slot is taken");
    __CPROVER_assert(slot_same(&queue, &before, x), "QUE_001_frame: no more is written");
}
