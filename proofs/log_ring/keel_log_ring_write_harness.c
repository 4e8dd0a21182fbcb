// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_write has_room held_between put_record place_behind count_lost
// covers: model_log_ring_write line_of lay_out
//
// Any ring of 8 bytes, any record of up to 9: the same as with an array that shifts.
#include "log_ring_proof.h"

void keel_log_ring_write_harness(void)
{
    keel_log_ring_t ring = any_ring();
    const keel_log_ring_t before = ring;
    keel_log_ring_t model = ring;
    uint8_t record[RECORD_MOST];
    const uint32_t size = any_size();
    const uint64_t now_us = nondet_u64();
    bool expected;
    bool written;

    any_bytes(record, RECORD_MOST);
    expected = model_log_ring_write(&model, record, size, now_us);

    written = keel_log_ring_write(&ring, record, size, now_us);

    __CPROVER_assert(written == expected, "RIN_005_model: written or lost as the model says");
    __CPROVER_assert(loss_same(&ring.loss, &model.loss),
                     "RIN_006_model: what is lost is counted as in the model");
    for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
        __CPROVER_assert(ring_same(&ring, &model, i),
                         "RIN_003_model: every field is what the model says");
    }
    __CPROVER_assert(ring_valid_here(&ring), "RIN_003_valid: it stays valid");
    __CPROVER_assert(ring.tail == before.tail, "RIN_004_tail: the reader's index is the reader's");
    if (!written) {
        __CPROVER_assert((ring.head == before.head) &&
                             bytes_equal(ring.buffer, before.buffer, KEEL_LOG_RING_BYTES),
                         "RIN_004_none: of a lost record there is nothing");
    }
}
