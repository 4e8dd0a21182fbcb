// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_find
#include "../common/keel_proof.h"

void keel_queue_find_harness(void)
{
    keel_queue_t queue;
    const uint32_t i = any_below(CAPACITY);
    const uint32_t place = any_below(CAPACITY + 1u);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    keel_queue_t before;
    uint32_t found;

    any_queue(&queue, place);
    before = queue;

    found = keel_queue_find(&queue, task);

    __CPROVER_assert(found <= queue.count, "QUE_002_range: the position is at most count");
    __CPROVER_assert((found == queue.count) || (queue.task[queue.order[found]] == task),
                     "QUE_002_found: the task is there");
    __CPROVER_assert((i >= found) || (queue.task[queue.order[i]] != task),
                     "QUE_002_absent: and nowhere before");
    __CPROVER_assert(found == (((task != NULL) && (place < queue.count)) ? place : queue.count),
                     "QUE_002_position: so it is the task's position");
    __CPROVER_assert(queue_same(&queue, &before, i), "QUE_002_frame: nothing is written");
}
