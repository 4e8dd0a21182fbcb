// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/queue.c specs/model/queue.c
// covers: keel_queue_find model_queue_find
#include "../../specs/model/queue.h"
#include "../common/keel_proof.h"

void keel_queue_find_harness(void)
{
    keel_queue_t queue;
    const uint32_t x = any_below(CAPACITY);
    const keel_task_config_t *const task = nondet_bool() ? &proof_task : NULL;
    keel_queue_t before;
    uint32_t found;

    any_queue(&queue, any_below(CAPACITY + 1u));
    before = queue;

    found = keel_queue_find(&queue, task);

    __CPROVER_assert(found == model_queue_find(&before, task), "QUE_002_model: as the model says");
    __CPROVER_assert(queue_same(&queue, &before, x), "QUE_002_frame: nothing is written");
}
