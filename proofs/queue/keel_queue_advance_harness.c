// SPDX-License-Identifier: Apache-2.0
// cbmc: --external-sat-solver cadical
// sources: src/rtos/queue.c specs/model/queue.c
// defines: -DKEEL_QUEUE_CAPACITY=4u
// covers: keel_queue_advance add_saturating model_queue_advance
//
// Bounded to periods up to 2^5 us and up to 2^8 us of lateness, where the solver comes to the end
// of the division. The contract under WP has no such bound, and determines both numbers
// (QUE_009_grid, QUE_009_skipped).
#include "../common/queue_contracts.h"

void keel_queue_advance_harness(void)
{
    keel_queue_t queue = nondet_queue();
    const uint32_t slot = any_below(CAPACITY);
    const uint32_t x = any_below(CAPACITY);
    uint64_t now_us;
    keel_queue_t expected;

    queue.period_us[slot] = any_bits(5u) + 1u;
    queue.release_us[slot] = any_bits64(62u);
    now_us = queue.release_us[slot] + any_bits64(8u);
    __CPROVER_assume(keel_queue_advance_may(&queue, slot, now_us));
    expected = queue;

    model_queue_advance(&expected, slot, now_us);
    keel_queue_advance(&queue, slot, now_us);

    __CPROVER_assert(keel_queue_advance_does(&queue, &expected, x),
                     "QUE_009_model: as the model says");
}
