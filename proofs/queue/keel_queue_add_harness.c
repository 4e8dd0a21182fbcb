// cbmc: --unwind 34
// sources: src/rtos/queue.c
// covers: keel_queue_add fill_slot open_place enqueue
// defines: -DKEEL_QUEUE_CAPACITY=16u
//
// Bounded to a capacity of 16 tasks, with which the solver comes to an end in a minute; the
// contract under WP has no bound.
#include "../common/keel_proof.h"

void keel_queue_add_harness(void)
{
    keel_queue_t queue;
    const uint64_t release_us = nondet_u64();
    const uint32_t i = any_below(CAPACITY);
    keel_queue_t before;
    keel_task_config_t config_before;
    uint32_t place;
    uint32_t slot;
    bool realtime;

    any_queue(&queue, CAPACITY);
    __CPROVER_assume(queue.count < CAPACITY);
    any_config(&proof_task);
    __CPROVER_assume(config_is_valid_here(&proof_task));
    before = queue;
    config_before = proof_task;
    realtime = proof_task.priority == KEEL_PRIORITY_REALTIME;
    place = realtime ? queue.realtime_count : queue.count;
    slot = queue.order[queue.count];

    keel_queue_add(&queue, &proof_task, release_us);

    ASSERT_QUEUE_VALID(&queue, "QUE_005");
    __CPROVER_assert(queue.count == (before.count + 1u), "QUE_003_order: one task more");
    __CPROVER_assert(queue.realtime_count == (before.realtime_count + (realtime ? 1u : 0u)),
                     "QUE_003_order: one real-time task more if it is one");
    __CPROVER_assert(queue.order[place] == slot, "QUE_003_order: last of its class, a free slot");
    __CPROVER_assert((i >= place) || (queue.order[i] == before.order[i]),
                     "QUE_003_order: the slots before it stay");
    __CPROVER_assert((i <= place) || (i >= queue.count) || (queue.order[i] == before.order[i - 1u]),
                     "QUE_003_order: those behind it move down by one");
    __CPROVER_assert((i < queue.count) || (queue.order[i] == before.order[i]),
                     "QUE_003_order: the free ones stay");
    if (i == slot) {
        __CPROVER_assert(queue.task[i] == &proof_task, "QUE_003_copied: the slot is the task's");
        __CPROVER_assert((queue.period_us[i] == proof_task.period_us) &&
                             (queue.budget_us[i] == proof_task.budget_us) &&
                             (queue.priority[i] == proof_task.priority),
                         "QUE_003_copied: with what is declared");
        __CPROVER_assert(queue.release_us[i] == release_us, "QUE_003_release: its first release");
        __CPROVER_assert((queue.skipped[i] == 0u) && stats_fresh(&queue.stats[i]),
                         "QUE_003_fresh: with nothing counted");
    } else {
        __CPROVER_assert((queue.task[i] == before.task[i]) && slot_same(&queue, &before, i),
                         "QUE_003_frame: no other slot is written");
    }
    __CPROVER_assert(config_same(&proof_task, &config_before),
                     "QUE_003_frame: nor is the declaration");
}
