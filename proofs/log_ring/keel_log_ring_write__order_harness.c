// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// defines: -DKEEL_LOG_RING_LOAD(i)=({uint32_t/**/ring_load(const/**/uint32_t*);ring_load(i);})
// defines: -DKEEL_LOG_RING_STORE(i,v)=({void/**/ring_store(uint32_t*,uint32_t);ring_store(i,v);})
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_write has_room held_between put_record place_behind count_lost
// covers: model_log_ring_write
//
// The order of the writer's accesses, for any ring of 8 bytes and any record of up to 9: it reads
// the reader's index once, before it writes to the buffer; it hands its own over once, behind all
// that it writes there; and what the reader may look at then is, byte by byte, what it has to be.
#include "log_ring_order.h"

void keel_log_ring_write__order_harness(void)
{
    keel_log_ring_t model;
    uint8_t record[RECORD_MOST];
    const uint32_t size = any_size();
    const uint64_t now_us = nondet_u64();
    const uint32_t stale = nondet_u32();
    bool expected;
    bool written;

    ring = any_ring();
    met = any_ring();
    later = any_ring();
    any_bytes(record, RECORD_MOST);
    met.head = ring.head;
    met.loss = ring.loss;
    theirs = &ring.tail;
    ours = &ring.head;
    model = met;
    expected = model_log_ring_write(&model, record, size, now_us);
    __CPROVER_assume(stale < KEEL_LOG_RING_BYTES);
    ring.tail = stale;

    written = keel_log_ring_write(&ring, record, size, now_us);

    __CPROVER_assert(written == expected, "RIN_009_written: by the index that was read");
    __CPROVER_assert(stores == (written ? 1u : 0u), "RIN_009_handed: handed over if written");
    __CPROVER_assert((ring.head == model.head) && (ring.tail == stale),
                     "RIN_009_index: its own index is the model's, and the other one untouched");
    if (written) {
        __CPROVER_assert((handed.head == model.head) &&
                             bytes_equal(handed.buffer, model.buffer, KEEL_LOG_RING_BYTES),
                         "RIN_009_bytes: every byte is there when it is handed over");
    }
    __CPROVER_assert(bytes_equal(ring.buffer, written ? later.buffer : met.buffer,
                                 KEEL_LOG_RING_BYTES),
                     "RIN_009_done: and none is written behind that");
    __CPROVER_assert(loss_same(&ring.loss, &model.loss), "RIN_009_loss: losses as in the model");
}
