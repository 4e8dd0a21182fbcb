// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/queue.c specs/model/queue.c
// covers: keel_queue_remove close_place model_queue_remove
#include "../common/queue_contracts.h"

void keel_queue_remove_harness(void)
{
    keel_queue_t queue;
    const uint32_t position = any_below(CAPACITY);
    const uint32_t x = any_below(CAPACITY);
    keel_queue_t expected;

    any_queue(&queue, position);
    __CPROVER_assume(keel_queue_remove_may(&queue, position));
    expected = queue;

    model_queue_remove(&expected, position);
    keel_queue_remove(&queue, position);

    __CPROVER_assert(keel_queue_remove_does(&queue, &expected, x),
                     "QUE_007_model: as the model says");
}
