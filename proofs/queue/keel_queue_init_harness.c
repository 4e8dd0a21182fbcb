// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// sources: src/rtos/queue.c specs/model/queue.c
// covers: keel_queue_init model_queue_init
#include "../../specs/model/queue.h"
#include "../common/keel_proof.h"

void keel_queue_init_harness(void)
{
    keel_queue_t queue = nondet_queue();
    const uint32_t x = any_below(CAPACITY);
    keel_queue_t expected = queue;

    model_queue_init(&expected);
    keel_queue_init(&queue);

    __CPROVER_assert(queue_same(&queue, &expected, x), "QUE_001_model: as the model says");
    ASSERT_QUEUE_VALID(&queue, "QUE_001_valid");
}
