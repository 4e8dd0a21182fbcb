// cbmc: --unwind 34 --external-sat-solver cadical
// sources: src/rtos/queue.c
// covers: keel_queue_remove close_slot
#include "../common/keel_proof.h"

void keel_queue_remove_harness(void)
{
    keel_queue_t queue;
    const uint32_t index = nondet_u32();
    const uint32_t i = any_below(CAPACITY);
    const uint32_t t = any_below(TASKS);
    keel_queue_t before;
    keel_task_t task_before;
    keel_task_config_t config_before;
    keel_status_t status;

    any_queue(&queue);
    before = queue;
    task_before = *proof_task[t];
    config_before = *proof_config[t];

    status = keel_queue_remove(&queue, index);

    assert_queue_valid(&queue);
    if (index < before.count) {
        __CPROVER_assert(status == KEEL_OK, "QUE_007_ok: a queued task can be removed");
        __CPROVER_assert((i >= queue.count) || (queue.task[i] != before.task[index]),
                         "QUE_007_gone: the task is queued no more");
        __CPROVER_assert(queue.count == (before.count - 1u), "QUE_007_count: one task less");
        __CPROVER_assert(queue.realtime_count ==
                             (before.realtime_count - ((index < before.realtime_count) ? 1u : 0u)),
                         "QUE_007_realtime: one real-time task less if it was one");
        __CPROVER_assert((i >= index) || (queue.task[i] == before.task[i]),
                         "QUE_008_before: the tasks before it stay");
        __CPROVER_assert((i < index) || (i >= queue.count) ||
                             (queue.task[i] == before.task[i + 1u]),
                         "QUE_008_behind: the tasks behind it move up one slot");
    } else {
        __CPROVER_assert(status == KEEL_ERR_UNKNOWN_TASK,
                         "QUE_004_unknown: no task has this index");
        __CPROVER_assert((queue.count == before.count) &&
                             (queue.realtime_count == before.realtime_count),
                         "QUE_004_unchanged: a refusal keeps the counts");
        __CPROVER_assert(queue.task[i] == before.task[i],
                         "QUE_004_unchanged: a refusal keeps the slots");
    }
    __CPROVER_assert(task_same(proof_task[t], &task_before) &&
                         config_same(proof_config[t], &config_before),
                     "QUE_007_frame: no task and no declaration is written");
}
