// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/queue.c specs/model/queue.c
// covers: keel_queue_add fill_slot open_place enqueue_task model_queue_add
#include "../common/queue_contracts.h"

void keel_queue_add_harness(void)
{
    keel_queue_t queue;
    const uint64_t release_us = nondet_u64();
    const uint32_t x = any_below(CAPACITY);
    keel_queue_t expected;
    keel_task_config_t declared;

    any_queue(&queue, CAPACITY);
    any_config(&proof_task);
    declared = proof_task;
    __CPROVER_assume(keel_queue_add_may(&queue, &proof_task));
    expected = queue;

    model_queue_add(&expected, &proof_task, release_us);
    keel_queue_add(&queue, &proof_task, release_us);

    __CPROVER_assert(keel_queue_add_does(&queue, &expected, x), "QUE_003_model: as the model says");
    __CPROVER_assert(config_same(&proof_task, &declared), "QUE_003_frame: the declaration stays");
}
