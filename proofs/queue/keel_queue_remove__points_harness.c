// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// checks: assertions
// sources: src/rtos/queue.c specs/model/queue.c
// defines: -DKEEL_QUEUE_CAPACITY=32u
// covers: keel_queue_remove close_place model_queue_remove
//
// A full queue loses its first task, its last or one between: the same as the model's. Mistakes
// that only many tasks show are refuted here in seconds; keel_queue_remove_harness has any queue.
#include "../common/many_tasks.h"

static const uint32_t point[] = {0u, CAPACITY / 2u, CAPACITY - 2u, CAPACITY - 1u};

void keel_queue_remove__points_harness(void)
{
    const uint32_t x = any_below(CAPACITY);

    for (uint32_t i = 0u; i < (sizeof(point) / sizeof(point[0])); i++) {
        keel_queue_t queue = queue_of(CAPACITY, CAPACITY - 3u);
        keel_queue_t expected = queue;

        model_queue_remove(&expected, point[i]);
        keel_queue_remove(&queue, point[i]);
        __CPROVER_assert(keel_queue_remove_does(&queue, &expected, x),
                         "QUE_007_model: as the model says");
    }
}
