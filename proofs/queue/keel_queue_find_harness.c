// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/queue.c
// covers: keel_queue_find
#include "../common/keel_proof.h"

void keel_queue_find_harness(void)
{
    keel_queue_t queue;
    const uint32_t i = any_below(CAPACITY);
    keel_task_t *task;
    keel_task_t *slot;
    uint32_t count;
    uint32_t found;

    any_queue(&queue);
    task = nondet_bool() ? proof_task[any_below(TASKS)] : NULL;
    slot = queue.task[i];
    count = queue.count;

    found = keel_queue_find(&queue, task);

    __CPROVER_assert(found <= queue.count, "QUE_002_range: the index is at most count");
    __CPROVER_assert((found == queue.count) || (queue.task[found] == task),
                     "QUE_002_found: the task is at the index");
    __CPROVER_assert((found < queue.count) || (i >= queue.count) || (queue.task[i] != task),
                     "QUE_002_absent: with no index the task is nowhere");
    __CPROVER_assert((queue.count == count) && (queue.task[i] == slot), "QUE_002: nothing changed");
}
