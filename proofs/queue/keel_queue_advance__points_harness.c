// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 34 --no-array-field-sensitivity
// checks: assertions
// sources: src/rtos/queue.c specs/model/queue.c
// defines: -DKEEL_QUEUE_CAPACITY=32u
// covers: keel_queue_advance add_saturating model_queue_advance
//
// Long periods, and so many missed ones that their count just fits, or does not: the same as the
// model's. Mistakes that only large numbers show are refuted here in seconds;
// keel_queue_advance_harness has all small ones.
#include "../common/many_tasks.h"

typedef struct {
    uint32_t period_us;
    uint64_t late_us;
    uint16_t skipped;
} point_t;

static const point_t point[] = {
    {1000u, 999u, 300u},
    {1000u, 1000u, 300u},
    {100u, 30000u, UINT16_MAX - 301u},
    {100u, 30000u, UINT16_MAX - 300u},
    {100u, 30000u, UINT16_MAX - 299u},
    {40u, 40u * (uint64_t)UINT16_MAX, 0u},
    {40u, 40u * ((uint64_t)UINT16_MAX + 1u), 0u},
    {40u, 40u * ((uint64_t)UINT16_MAX + 9u), UINT16_MAX},
    {KEEL_PERIOD_LIMIT_US - 1u, 7u * (uint64_t)KEEL_PERIOD_LIMIT_US, 3u},
};

void keel_queue_advance__points_harness(void)
{
    const uint32_t x = any_below(CAPACITY);
    const uint32_t slot = CAPACITY - 1u;

    for (uint32_t i = 0u; i < (sizeof(point) / sizeof(point[0])); i++) {
        keel_queue_t queue = queue_of(CAPACITY, 2u);
        const uint64_t now_us = queue.release_us[slot] + point[i].late_us;
        keel_queue_t expected;

        queue.period_us[slot] = point[i].period_us;
        queue.skipped[slot] = point[i].skipped;
        expected = queue;
        model_queue_advance(&expected, slot, now_us);
        keel_queue_advance(&queue, slot, now_us);
        __CPROVER_assert(keel_queue_advance_does(&queue, &expected, x),
                         "QUE_009_model: as the model says");
    }
}
