// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// defines: -DKEEL_LOG_RING_LOAD(i)=({uint32_t/**/ring_load(const/**/uint32_t*);ring_load(i);})
// defines: -DKEEL_LOG_RING_STORE(i,v)=({void/**/ring_store(uint32_t*,uint32_t);ring_store(i,v);})
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_take_loss has_room held_between model_log_ring_take_loss
//
// Telling a loss is the writer's affair, too: it may read the reader's index, so, and once; and it
// hands nothing over.
#include "log_ring_order.h"

void keel_log_ring_take_loss__order_harness(void)
{
    keel_log_ring_t model;
    keel_log_ring_loss_t loss = nondet_loss();
    keel_log_ring_loss_t expected_loss = loss;
    const uint32_t size = any_size();
    const uint32_t stale = nondet_u32();
    bool expected;
    bool told;

    ring = any_ring();
    met = ring;
    met.tail = nondet_u32();
    __CPROVER_assume((met.tail < KEEL_LOG_RING_BYTES) && (stale < KEEL_LOG_RING_BYTES));
    theirs = &ring.tail;
    model = met;
    expected = model_log_ring_take_loss(&model, size, &expected_loss);
    ring.tail = stale;

    told = keel_log_ring_take_loss(&ring, size, &loss);

    __CPROVER_assert(told == expected, "RIN_009_told: by the index that was read");
    __CPROVER_assert((stores == 0u) && loss_same(&loss, &expected_loss) &&
                         loss_same(&ring.loss, &model.loss),
                     "RIN_009_loss: what was lost as in the model, and nothing is handed over");
    __CPROVER_assert((ring.head == met.head) && (ring.tail == stale) &&
                         bytes_equal(ring.buffer, met.buffer, KEEL_LOG_RING_BYTES),
                     "RIN_009_kept: no index, and no byte of the buffer");
}
