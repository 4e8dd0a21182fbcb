// SPDX-License-Identifier: Apache-2.0
// cbmc: --unwind 10 --external-sat-solver cadical
// defines: -DKEEL_LOG_RING_BYTES=8u
// sources: src/middleware/log_ring.c specs/model/log_ring.c
// covers: keel_log_ring_write keel_log_ring_read
//
// The two sides at the same time: the writer may not have seen yet that the reader took bytes, nor
// the reader that the writer brought some. Then the one's call ends as if the other's had come
// first: a record that fits without what the reader frees lies, with all its bytes, where it would
// lie then; and what the reader takes of that which was there is the same. As each side writes its
// index last, this holds of any order in which the steps of the two calls come.
#include "log_ring_proof.h"

void keel_log_ring_write__meanwhile_harness(void)
{
    keel_log_ring_t ring[2];
    uint8_t record[RECORD_MOST];
    uint8_t taken[2][RECORD_MOST] = {{0}};
    const uint32_t size = any_size();
    const uint32_t most = nondet_u32();
    bool fits[2] = {false, false};

    ring[0] = any_ring();
    ring[1] = ring[0];
    __CPROVER_assume(most <= keel_log_ring_held(&ring[0]));
    any_bytes(record, RECORD_MOST);
    for (uint32_t turn = 0u; turn < 4u; turn++) {
        const uint32_t i = turn / 2u; /* Ring 0: written, then read; ring 1: read, then written. */

        if ((turn == 0u) || (turn == 3u)) {
            fits[i] = keel_log_ring_write(&ring[i], record, size, 0u);
        } else {
            __CPROVER_assert(keel_log_ring_read(&ring[i], taken[i], most) == most,
                             "RIN_009_count: what was there is taken");
        }
    }

    __CPROVER_assert(bytes_equal(taken[0], taken[1], RECORD_MOST),
                     "RIN_009_same: and it is the same");
    __CPROVER_assert(fits[1] || !fits[0], "RIN_009_fits: what fitted before fits after");
    if (fits[0]) {
        for (uint32_t i = 0u; i < KEEL_LOG_RING_BYTES; i++) {
            __CPROVER_assert(ring_same(&ring[0], &ring[1], i),
                             "RIN_009_ring: both sides, and every byte, are where they would be");
        }
    }
}
