// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// defines: -DKEEL_LOG_RING_LOAD(i)=({uint32_t/**/ring_load(const/**/uint32_t*);ring_load(i);})
// defines: -DKEEL_LOG_RING_STORE(i,v)=({void/**/ring_store(uint32_t*,uint32_t);ring_store(i,v);})
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_read keel_log_ring_held held_between place_behind model_log_ring_read
//
// The order of the reader's accesses, for any ring of 8 bytes: it reads the writer's index once,
// before it looks into the buffer; it hands its own over once, behind the last byte that it takes
// from there; and it writes nothing else of the ring.
#include "log_ring_order.h"

void keel_log_ring_read__order_harness(void)
{
    keel_log_ring_t model;
    keel_log_ring_loss_t loss;
    uint8_t taken[RECORD_MOST];
    uint8_t expected_bytes[RECORD_MOST];
    const uint32_t most = any_size();
    const uint32_t stale = nondet_u32();
    uint32_t expected;
    uint32_t count;

    ring = any_ring();
    loss = ring.loss;
    met = any_ring();
    later = any_ring();
    any_bytes(taken, RECORD_MOST);
    for (uint32_t i = 0u; i < RECORD_MOST; i++) {
        expected_bytes[i] = taken[i];
    }
    met.tail = ring.tail;
    theirs = &ring.head;
    ours = &ring.tail;
    model = met;
    expected = model_log_ring_read(&model, expected_bytes, most);
    __CPROVER_assume(stale < KEEL_LOG_RING_BYTES);
    ring.head = stale;

    count = keel_log_ring_read(&ring, taken, most);

    __CPROVER_assert(count == expected, "RIN_009_count: by the index that was read");
    __CPROVER_assert(bytes_equal(taken, expected_bytes, RECORD_MOST),
                     "RIN_009_taken: every byte is taken before its place is handed over");
    __CPROVER_assert((stores == 1u) && (ring.tail == model.tail) && (ring.head == stale),
                     "RIN_009_index: its own index is the model's, and the other one untouched");
    __CPROVER_assert(bytes_equal(handed.buffer, met.buffer, KEEL_LOG_RING_BYTES) &&
                         bytes_equal(ring.buffer, later.buffer, KEEL_LOG_RING_BYTES) &&
                         loss_same(&ring.loss, &loss),
                     "RIN_009_only: and nothing else is written");
}
