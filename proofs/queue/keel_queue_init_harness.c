// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_init
#include "../common/keel_proof.h"

void keel_queue_init_harness(void)
{
    keel_queue_t queue;
    const uint32_t i = any_below(CAPACITY);

    keel_queue_init(&queue);

    __CPROVER_assert(queue.count == 0u, "QUE_001: the queue is empty");
    __CPROVER_assert(queue.realtime_count == 0u, "QUE_001: it holds no real-time task");
    __CPROVER_assert(queue.task[i] == NULL, "QUE_001: no slot holds a task");
}
