// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_take_loss keel_log_ring_write
//
// What is told can be written: there is room for what tells it.
#include "log_ring_proof.h"

void keel_log_ring_take_loss__written_harness(void)
{
    keel_log_ring_t ring = any_ring();
    keel_log_ring_loss_t loss;
    uint8_t record[RECORD_MOST];
    const uint32_t room = nondet_u32();
    const uint32_t size = any_size();

    any_bytes(record, RECORD_MOST);
    if (keel_log_ring_take_loss(&ring, room, &loss)) {
        const bool written = keel_log_ring_write(&ring, record, size, 0u);

        __CPROVER_assert(written || (size > room), "RIN_007_room: the record that tells it fits");
        __CPROVER_assert(written == (ring.loss.records == 0u),
                         "RIN_007_none: and none is lost meanwhile");
    }
}
