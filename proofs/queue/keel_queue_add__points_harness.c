// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// checks: assertions
// sources: src/rtos/queue.c specs/model/queue.c
// defines: -DKEEL_QUEUE_CAPACITY=32u
// covers: keel_queue_add fill_slot open_place enqueue_task model_queue_add
//
// A task comes into a queue with one place left, before all others, between them or behind them:
// the same as the model's. Mistakes that only many tasks show are refuted here in seconds;
// keel_queue_add_harness has any queue.
#include "../common/many_tasks.h"

typedef struct {
    uint8_t realtime_count;
    uint8_t priority;
} point_t;

static const point_t point[] = {
    {0u, KEEL_PRIORITY_REALTIME},
    {CAPACITY / 2u, KEEL_PRIORITY_REALTIME},
    {CAPACITY / 2u, KEEL_PRIORITY_LOW},
    {CAPACITY - 1u, KEEL_PRIORITY_REALTIME},
};

void keel_queue_add__points_harness(void)
{
    const uint32_t x = any_below(CAPACITY);

    for (uint32_t i = 0u; i < (sizeof(point) / sizeof(point[0])); i++) {
        keel_queue_t queue = queue_of(CAPACITY - 1u, point[i].realtime_count);
        keel_queue_t expected = queue;

        proof_task = (keel_task_config_t){
            .period_us = 2000u, .budget_us = 40u, .priority = point[i].priority};
        model_queue_add(&expected, &proof_task, 3000u);
        keel_queue_add(&queue, &proof_task, 3000u);
        __CPROVER_assert(keel_queue_add_does(&queue, &expected, x),
                         "QUE_003_model: as the model says");
    }
}
